// Processor time of the calling thread, or of all threads of the process, so that other work on the machine does not
// count.
#pragma once

#include <time.h>

namespace bihive::test {

inline double clock_ms(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

inline double thread_time_ms() {
  return clock_ms(CLOCK_THREAD_CPUTIME_ID);
}

inline double process_time_ms() {
  return clock_ms(CLOCK_PROCESS_CPUTIME_ID);
}

}  // namespace bihive::test
