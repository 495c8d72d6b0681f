// The result of a call that continues the picture.
#pragma once

namespace bihive {

struct FrameReport {
  bool drawn = false;     ///< there is a new picture to show
  bool settled = false;   ///< complete: frame() does nothing until something changes
  double done = 0;        ///< of the picture at rest, 0 to 1
  int divisor = 1;        ///< divides width and height: 1 is every pixel
  double frame_ms = 0;    ///< of this call
  double fps = 0;         ///< over the last second of moving frames; 0: none yet
  double mray_per_s = 0;  ///< rays of all kinds
};

}  // namespace bihive
