// The points on a camera's lens through which the samples of a pixel see.
//
// They are the same in every pixel, so neighbouring pixels see along neighbouring rays, and the picture has no noise.
#pragma once

#include <vector>

#include "bihive/scene/camera.h"
#include "bihive/scene/sample_pattern.h"

namespace bihive {

/// A sample: its position in the pixel and on the lens.
struct CameraSample {
  SamplePlace place;
  LensPlace lens;
};

/// The n samples of a pixel, n at least 1: sample_place() in the pixel, and as many points on the lens that fill the
/// disc evenly [Vogel1979]. The only sample of n = 1 is in the middle of the lens.
std::vector<CameraSample> camera_samples(int n);

}  // namespace bihive
