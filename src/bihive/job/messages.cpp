#include "bihive/job/messages.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <mutex>
#include <unordered_set>

#include "bihive/base/setting_name.h"
#include "bihive/job/failure.h"

namespace bihive {
namespace {

constexpr double kFirstDrawMs = 1000;
constexpr double kRedrawMs = 100;
constexpr double kFirstLineMs = 5000, kNextLineMs = 10000;
constexpr int kBarCharacters = 24;

std::atomic<bool> g_once{false};
bool g_in_lines = false;  // progress without a terminal

// Progress for a program that reads it.
bool shows_shares() {
  static const bool shows = [] {
    const char* const form = std::getenv("BIHIVE_PROGRESS");  // NOLINT(concurrency-mt-unsafe)
    return form != nullptr && std::string_view(form) == "shares";
  }();
  return shows;
}

thread_local std::vector<std::string>* t_collected = nullptr;

// All messages of the program go through this, because file names and other texts of users may contain anything.
void put(std::FILE* stream, const std::string& text) {
  const std::string safe = escaped_lines(text);
  std::fwrite(safe.data(), 1, safe.size(), stream);
}

void say(const std::string& text) {
  put(stderr, "bihive: " + escaped(text) + "\n");
}

}  // namespace

void name_settings_as_options() {
  const char* const names = std::getenv("BIHIVE_SETTING_NAMES");
  if (names == nullptr || std::string_view(names) != "ids") name_settings_by(&option_of_setting);
}

void warn_of_each_text_once() {
  g_once = true;
}

CollectedWarnings::CollectedWarnings(std::vector<std::string>& texts) {
  t_collected = &texts;
}

CollectedWarnings::~CollectedWarnings() {
  t_collected = nullptr;
}

void warn(const std::string& text) {
  if (t_collected != nullptr) return t_collected->push_back(text);
  if (g_once) {
    static std::mutex mutex;
    static std::unordered_set<std::size_t> said;  // hashes: a film may have a warning for each frame
    const std::lock_guard<std::mutex> lock(mutex);
    if (!said.insert(std::hash<std::string>()(text)).second) return;
    // There may be a progress line of another thread.
    if (isatty(STDERR_FILENO) != 0) std::fputs("\r\033[K", stderr);
  }
  say("warning: " + text);
}

void warn(const std::vector<std::string>& texts) {
  for (const std::string& text : texts) warn(text);
}

void say_error(const std::string& text) {
  say("error: " + text);
}

void say_lines(const std::string& text) {
  put(stderr, text);
}

void print(const std::string& text) {
  put(stdout, text);
}

void finish_output() {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  const int code = errno != 0 ? errno : EIO;
  fail({"writing to the standard output failed: " + std::string(std::strerror(code)), "", 0, 0, ""});
}

std::string readable_ms(double ms) {
  if (ms < 999.5) return fmt::format("{:.3g} ms", ms);
  if (ms < 120e3) return fmt::format("{:.3g} s", ms / 1000);
  return fmt::format("{:.0f} min {:.0f} s", std::floor(ms / 60e3), std::floor(std::fmod(ms / 1000, 60)));
}

void show_progress_in_lines() {
  g_in_lines = true;
}

Progress::Progress(const std::string& what)
    : what_(escaped(what)),
      terminal_(isatty(STDERR_FILENO) != 0),
      next_draw_ms_(shows_shares() ? 0
                    : terminal_    ? kFirstDrawMs
                                   : kFirstLineMs) {}

Progress::~Progress() {
  if (drawn_) std::fputs("\r\033[K", stderr);
}

void Progress::update(double done) {
  const double elapsed = timer_.elapsed_ms();
  if (shows_shares()) {
    if (elapsed < next_draw_ms_) return;
    next_draw_ms_ = elapsed + kRedrawMs;
    return say(fmt::format("progress: {} {:.4f}", what_, done));
  }
  if (!(terminal_ || g_in_lines) || elapsed < next_draw_ms_ || done >= 1) return;
  next_draw_ms_ = elapsed + (terminal_ ? kRedrawMs : kNextLineMs);
  const std::string left = done > 0 ? readable_ms(std::ceil(elapsed * (1 - done) / done / 1000) * 1000) + " left" : "";
  if (!terminal_) {
    fmt::print(stderr, "{}: {:.0f} %{}{}\n", what_, 100 * done, left.empty() ? "" : ", ", left);
    std::fflush(stderr);
    return;
  }
  drawn_ = true;
  const int filled = std::clamp(static_cast<int>(done * kBarCharacters), 0, kBarCharacters);
  fmt::print(stderr, "\r\033[K{} [{:<{}}] {:3.0f} % {}", what_, std::string(static_cast<std::size_t>(filled), '#'),
             kBarCharacters, 100 * done, left);
  std::fflush(stderr);
}

}  // namespace bihive
