#include "c_progress.h"

namespace {

thread_local bihive::c::Progress progress;

}  // namespace

bihive::c::Progress bihive::c::progress_of_thread() noexcept {
  return progress;
}

void bihive_set_progress(bihive_progress report, void* context) {
  progress = {report, context};
}
