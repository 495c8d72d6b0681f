#include "support/interrupt.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <climits>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <ctime>

namespace bihive::cli {
namespace {

enum Section : int { kOutside, kCancellable, kWriting, kWritten };

// The variables that a signal handler may use: lock-free atomics only.
std::atomic<int> g_section{kOutside};
std::atomic<int> g_signal{0};
std::atomic<std::int64_t> g_first_ms{0};
CancelToken g_token;
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free);

// A signal that follows the first within this time is the same request: timeout(1) sends each of its signals twice.
constexpr std::int64_t kSameRequestMs = 300;

std::int64_t now_ms() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1000 + now.tv_nsec / 1000000;
}

// The files to remove; the first byte is 0 if there is none. No command writes more at a time.
constexpr int kMostUnfinished = 8;
char g_unfinished[kMostUnfinished][PATH_MAX];
int g_folders[kMostUnfinished];

// The process groups to end; 0: none.
constexpr std::size_t kMostGroups = 2;
std::atomic<int> g_groups[kMostGroups];

}  // namespace

void remove_unfinished() {
  for (const auto& group : g_groups)
    if (const int number = group.load(); number > 0) kill(-number, SIGKILL);
  for (int i = kMostUnfinished - 1; i >= 0; --i)
    if (g_unfinished[i][0] != 0 && unlinkat(g_folders[i], g_unfinished[i], 0) != 0)
      unlinkat(g_folders[i], g_unfinished[i], AT_REMOVEDIR);
}

namespace {

// Ends the program at any point; clears a progress line on a terminal first.
[[noreturn]] void end_at_once(int signal) {
  remove_unfinished();
  if (isatty(STDERR_FILENO) != 0) {
    const char wipe[] = "\r\033[K";
    [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, wipe, sizeof(wipe) - 1);
  }
  _exit(128 + signal);
}

void on_signal(int signal) {
  const int section = g_section.load();
  const std::int64_t now = now_ms();
  std::int64_t first_ms = 0;
  const bool first = g_first_ms.compare_exchange_strong(first_ms, now);
  const bool same_request = first || now - first_ms < kSameRequestMs;
  g_signal.store(signal);
  if (section == kWriting) return;
  if (section == kWritten && same_request) return;
  if (section == kCancellable && same_request) return g_token.cancel();
  end_at_once(signal);
}

}  // namespace

void handle_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler == SIG_IGN) continue;
    struct sigaction action {};
    action.sa_handler = on_signal;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
  }
  std::signal(SIGXFSZ, SIG_IGN);
}

CancellableSection::CancellableSection() {
  g_section.store(kCancellable);
}
CancellableSection::~CancellableSection() {
  g_section.store(kOutside);
}

const CancelToken& CancellableSection::token() {
  return g_token;
}

void CancellableSection::leave_if_cancelled() {
  if (g_token.cancelled()) end_at_once(g_signal.load());
}

WritingSection::WritingSection() {
  g_section.store(kWriting);
  // A signal between the section before and this one still counts.
  if (g_signal.load() != 0) end_at_once(g_signal.load());
}
WritingSection::~WritingSection() {
  g_section.store(kWritten);
}

StreamSection::StreamSection(bool active) : before_(g_section.load()), active_(active) {
  if (!active_) return;
  g_section.store(kOutside);
  // A signal before this moment only set the token.
  CancellableSection::leave_if_cancelled();
}
StreamSection::~StreamSection() {
  if (active_) g_section.store(before_);
}

RemovedWhenEnded::RemovedWhenEnded(const std::string& path, int folder) {
  if (path.empty() || path.size() >= PATH_MAX) return;
  for (int i = 0; i < kMostUnfinished; ++i) {
    char* const place = g_unfinished[i];
    if (place[0] != 0) continue;
    g_folders[i] = folder < 0 ? AT_FDCWD : folder;
    // The first byte is written last, so that a signal finds the whole path.
    std::memcpy(place + 1, path.c_str() + 1, path.size());
    std::atomic_signal_fence(std::memory_order_release);
    place[0] = path[0];
    place_ = place;
    return;
  }
}
RemovedWhenEnded::~RemovedWhenEnded() {
  if (place_ != nullptr) place_[0] = 0;
}

KilledWhenEnded::KilledWhenEnded(int group) : at_(kMostGroups) {
  for (std::size_t i = 0; i < kMostGroups && at_ == kMostGroups; ++i) {
    int none = 0;
    if (g_groups[i].compare_exchange_strong(none, group)) at_ = i;
  }
}
KilledWhenEnded::~KilledWhenEnded() {
  if (at_ < kMostGroups) g_groups[at_].store(0);
}

}  // namespace bihive::cli
