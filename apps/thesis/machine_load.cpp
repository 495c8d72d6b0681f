#include "machine_load.h"

#include <fmt/format.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <sstream>

namespace bihive::thesis {
namespace {

// The processors that this program may use; other processors' work does not disturb it.
int allowed_processors(cpu_set_t& set) {
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof(set), &set) != 0) return 0;
  return CPU_COUNT(&set);
}

// Seconds of work of the allowed processors, by Linux's own books; negative if there are none.
double busy_seconds() {
  cpu_set_t allowed;
  if (allowed_processors(allowed) == 0) return -1;
  const double ticks = static_cast<double>(sysconf(_SC_CLK_TCK));
  std::ifstream file("/proc/stat");
  double busy = 0;
  bool found = false;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("cpu", 0) != 0 || line.size() < 4 || line[3] < '0' || line[3] > '9') continue;
    std::istringstream fields(line.substr(3));
    int processor = 0;
    double user = 0, nice = 0, system = 0, idle = 0, waiting = 0, irq = 0, softirq = 0, steal = 0;
    fields >> processor >> user >> nice >> system >> idle >> waiting >> irq >> softirq >> steal;
    if (fields.fail() || !CPU_ISSET(static_cast<std::size_t>(processor), &allowed)) continue;
    busy += (user + nice + system + irq + softirq + steal) / ticks;
    found = true;
  }
  return found ? busy : -1;
}

double own_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace

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

LoadWatch::Times LoadWatch::now() {
  Times times;
  times.wall = std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  times.busy = busy_seconds();
  times.own = own_seconds();
  times.known = times.busy >= 0;
  return times;
}

LoadWatch::LoadWatch() : start_(now()) {
  cpu_set_t allowed;
  processors_ = allowed_processors(allowed);
}

MachineLoad LoadWatch::so_far() const {
  const Times end = now();
  MachineLoad load;
  load.seconds = end.wall - start_.wall;
  load.known = start_.known && end.known && processors_ > 0;
  const double all = load.seconds * processors_;
  if (load.known && all > 0)
    load.others = std::clamp(((end.busy - start_.busy) - (end.own - start_.own)) / all, 0.0, 1.0);
  // The books count in hundredths of a second: a shorter step says nothing.
  load.most_others = load.seconds > 1 ? load.others : 0;
  return load;
}

}  // namespace bihive::thesis
