// The processor time of the calling thread, so that other work on the machine does not count.
#pragma once

#include <time.h>

namespace bihive::test {

inline double thread_time_ms() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

}  // namespace bihive::test
