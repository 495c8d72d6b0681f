// Other work of the machine while something was measured.
#pragma once

#include <ctime>

namespace bihive::thesis {

/// CLOCK_MONOTONIC, or processor time of this program or of this thread.
double seconds_by(clockid_t clock);

/// Rates that were measured beside more work of other programs are not to be trusted: a share of the processors' time.
constexpr double kBusy = 0.05;

/// Watches the processors that this program may use, from its construction on.
class LoadWatch {
 public:
  LoadWatch();
  /// The share of their time that went to other programs, 0 to 1. Negative: unknown, because the system does not report
  /// it, or because less than a second has passed (the accounting counts in hundredths).
  double others() const;

 private:
  double wall_, busy_, own_;  // seconds; the processors' work is summed over those that this program may use
};

}  // namespace bihive::thesis
