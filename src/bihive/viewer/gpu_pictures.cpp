#include "bihive/viewer/gpu_pictures.h"

namespace bihive {

Result<std::unique_ptr<GpuPictures>> GpuPictures::create(const GlFunctions&) {
  return Error{"this build has no renderer for graphics processors", "", 0, 0, ""};
}

}  // namespace bihive
