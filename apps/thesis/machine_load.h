// Other work of the machine while something was measured.
#pragma once

#include <ctime>
#include <nlohmann/json.hpp>
#include <string>

namespace bihive::thesis {

/// CLOCK_MONOTONIC, or processor time of this program or of this thread.
double seconds_by(clockid_t clock);

/// A stretch of time on the processors that this program may use.
struct MachineLoad {
  double seconds = 0;      ///< all of it; 0: nothing was measured
  double others = 0;       ///< the share of the processors' time that went to other programs, 0 to 1
  bool known = false;      ///< the machine reports it
  double most_others = 0;  ///< the largest share in one of the stretches

  /// Both together.
  void add(const MachineLoad& part);
  /// Rates that were measured meanwhile are not to be trusted: more than a twentieth in one of the stretches.
  bool busy() const { return known && most_others > 0.05; }
  /// "0.4 % (at most 1.2 % in a step)".
  std::string text() const;
  /// The form of results.json, with null where a share is unknown.
  nlohmann::ordered_json json() const;
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(MachineLoad, seconds, others, known, most_others)

/// Watches from its construction on.
class LoadWatch {
 public:
  LoadWatch();
  MachineLoad so_far() const;

 private:
  double wall_, busy_, own_;  // seconds; the processors' work is summed over those that this program may use
};

}  // namespace bihive::thesis
