#include "statistics.h"

#include <ctime>

namespace bihive::thesis {
namespace {

// Other work on the machine hardly affects it.
double thread_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

}  // namespace

Json times_in_turns(const Experiment& experiment, int rounds, const Contestants& contestants) {
  Json times = Json::object();
  for (const auto& [name, run] : contestants) times[name] = Json::array();
  for (int round = 0; round <= rounds; ++round)
    for (std::size_t turn = 0; turn < contestants.size(); ++turn) {
      if (experiment.cancel.cancelled()) return {};
      const auto& [name, run] = contestants[round % 2 == 0 ? turn : contestants.size() - 1 - turn];
      const double before = thread_ms();
      run();
      if (round > 0) times[name].push_back(thread_ms() - before);
    }
  return times;
}

}  // namespace bihive::thesis
