// Time since construction that queries on some threads take.
#pragma once

#include <ctime>

#include "bihive/base/timer.h"

namespace bihive {

/// For work on the calling thread alone (`threads` 1) it is that thread's processor time, so that other programs do
/// not count; for more threads, or where the system does not tell, it is wall-clock time.
class ThreadTimer {
 public:
  explicit ThreadTimer(int threads) : alone_(threads == 1), began_ms_(alone_ ? own_ms() : 0) {}

  double elapsed_ms() const { return began_ms_ > 0 ? own_ms() - began_ms_ : timer_.elapsed_ms(); }

 private:
  // 0: not known.
  static double own_ms() {
#ifdef CLOCK_THREAD_CPUTIME_ID
    timespec now{};
    if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now) == 0)
      return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
#endif
    return 0;
  }

  bool alone_;
  double began_ms_;
  Timer timer_;
};

}  // namespace bihive
