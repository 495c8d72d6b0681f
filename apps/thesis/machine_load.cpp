#include "machine_load.h"

#include <fmt/format.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace bihive::thesis {
namespace {

// The processors that this program may use; other processors' work does not disturb it.
cpu_set_t allowed_processors() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof(set), &set) != 0) CPU_ZERO(&set);
  return set;
}

// Seconds of work of the allowed processors, by Linux's accounting; negative if there is none.
double busy_seconds() {
  const cpu_set_t allowed = allowed_processors();
  std::ifstream file("/proc/stat");
  double ticks = 0;
  bool found = false;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("cpu", 0) != 0 || line.size() < 4 || line[3] < '0' || line[3] > '9') continue;
    // Columns: user, nice, system, idle, waiting, irq, softirq, steal.
    std::istringstream fields(line.substr(3));
    std::size_t processor = 0;
    fields >> processor;
    double work = 0, column = 0;
    for (int i = 0; i < 8 && fields >> column; ++i) work += i == 3 || i == 4 ? 0 : column;
    if (fields.fail() || !CPU_ISSET(processor, &allowed)) continue;
    ticks += work;
    found = true;
  }
  return found ? ticks / static_cast<double>(sysconf(_SC_CLK_TCK)) : -1;
}

}  // namespace

double seconds_by(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void MachineLoad::add(const MachineLoad& part) {
  const double all = seconds + part.seconds;
  if (all > 0) others = (others * seconds + part.others * part.seconds) / all;
  known = (seconds == 0 || known) && part.known;
  seconds = all;
  most_others = std::max(most_others, part.most_others);
}

std::string MachineLoad::text() const {
  if (seconds == 0) return "nothing was measured";
  if (!known) return "unknown on this system";
  return fmt::format(
      "{:.1f} % of the processors' time went to other programs while it measured, {:.1f} % in the worst step of those "
      "that took over a second",
      100 * others, 100 * most_others);
}

nlohmann::ordered_json MachineLoad::json() const {
  using Json = nlohmann::ordered_json;
  return {{"seconds", seconds},
          {"others", known ? Json(others) : Json()},
          {"most_others", known ? Json(most_others) : Json()},
          {"busy", busy()}};
}

LoadWatch::LoadWatch()
    : wall_(seconds_by(CLOCK_MONOTONIC)), busy_(busy_seconds()), own_(seconds_by(CLOCK_PROCESS_CPUTIME_ID)) {}

MachineLoad LoadWatch::so_far() const {
  MachineLoad load;
  load.seconds = seconds_by(CLOCK_MONOTONIC) - wall_;
  const cpu_set_t allowed = allowed_processors();
  const double all = load.seconds * CPU_COUNT(&allowed), busy = busy_seconds();
  load.known = busy_ >= 0 && busy >= 0;
  const double own = seconds_by(CLOCK_PROCESS_CPUTIME_ID) - own_;
  if (load.known && all > 0) load.others = std::clamp((busy - busy_ - own) / all, 0.0, 1.0);
  // The accounting counts in hundredths of a second: a shorter step tells nothing.
  load.most_others = load.seconds > 1 ? load.others : 0;
  return load;
}

}  // namespace bihive::thesis
