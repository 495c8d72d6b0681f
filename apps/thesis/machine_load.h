// Other work of the machine while something was measured.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace bihive::thesis {

/// A stretch of time on the processors that this program may use.
struct MachineLoad {
  double seconds = 0;      ///< all of it; 0: nothing was measured
  double others = 0;       ///< the share of the processors' time that went to other programs, 0 to 1
  bool known = false;      ///< the machine told it
  double most_others = 0;  ///< the largest share in one of the parts

  /// Both together.
  void add(const MachineLoad& part);
  /// Rates that were measured meanwhile are not to be trusted.
  bool busy() const { return known && most_others > kBusy; }
  /// "0.4 % (at most 1.2 % in a step)".
  std::string text() const;

  /// Beyond this share in one of the parts a machine counts as busy.
  static constexpr double kBusy = 0.05;
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(MachineLoad, seconds, others, known, most_others)

/// Watches from its construction on.
class LoadWatch {
 public:
  LoadWatch();
  MachineLoad so_far() const;

 private:
  struct Times {
    double wall = 0, busy = 0, own = 0;  // seconds; busy and own are summed over processors
    bool known = false;
  };
  static Times now();

  Times start_;
  int processors_;
};

}  // namespace bihive::thesis
