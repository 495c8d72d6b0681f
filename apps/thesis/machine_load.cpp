#include "machine_load.h"

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

LoadWatch::LoadWatch()
    : wall_(seconds_by(CLOCK_MONOTONIC)), busy_(busy_seconds()), own_(seconds_by(CLOCK_PROCESS_CPUTIME_ID)) {}

double LoadWatch::others() const {
  const cpu_set_t allowed = allowed_processors();
  const double seconds = seconds_by(CLOCK_MONOTONIC) - wall_, busy = busy_seconds();
  if (busy_ < 0 || busy < 0 || seconds < 1) return -1;
  const double own = seconds_by(CLOCK_PROCESS_CPUTIME_ID) - own_;
  return std::clamp((busy - busy_ - own) / (seconds * CPU_COUNT(&allowed)), 0.0, 1.0);
}

}  // namespace bihive::thesis
