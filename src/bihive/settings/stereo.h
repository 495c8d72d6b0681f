// Two views of a picture, one for each eye.
#pragma once

namespace bihive {

/// side: the left eye's view in the left half of the picture, the right eye's in the right half, for parallel viewing
/// and headsets. cross: the other way round, for crossed eyes. anaglyph: for glasses with a red glass at the left and a
/// cyan one at the right: the luminance of the left view is red, that of the right one green and blue.
enum class StereoForm { none, side, cross, anaglyph };

constexpr double kMostEyeDistance = 1;

/// The eyes lie beside the camera and look in parallel; their frusta are sheared so that both show the same rectangle
/// at the camera's target, which appears to lie in the plane of the screen.
struct Stereo {
  StereoForm form = StereoForm::none;
  double eye_distance = 1.0 / 30;  ///< between the eyes, as a share of the distance to the target

  bool halves() const { return form == StereoForm::side || form == StereoForm::cross; }
};

}  // namespace bihive
