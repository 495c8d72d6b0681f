// The program's messages on stderr, and results on stdout. Every text is safe for a terminal, whatever it contains
// (base/readable.h: escaped_lines()).
#pragma once

#include <string>
#include <vector>

#include "bihive/base/readable.h"
#include "bihive/base/timer.h"

namespace bihive {

/// "bihive: warning: ..." in one line.
void warn(const std::string& text);
void warn(const std::vector<std::string>& texts);
/// Drops warnings whose text was printed before: for commands that read many frames. Then any number of threads may
/// warn.
void warn_of_each_text_once();
/// While it exists, this thread's warnings go into the list instead of stderr: for callers that show them in their own
/// way.
class CollectedWarnings {
 public:
  explicit CollectedWarnings(std::vector<std::string>& texts);
  ~CollectedWarnings();
  CollectedWarnings(const CollectedWarnings&) = delete;
  CollectedWarnings& operator=(const CollectedWarnings&) = delete;
};
/// "bihive: error: ..." in one line.
void say_error(const std::string& text);

/// Makes messages name settings as options: "--radius-scale" (base/setting_name.h). If the environment has
/// BIHIVE_SETTING_NAMES=ids, they keep their ids: for packages that run this program and show its messages.
void name_settings_as_options();

/// Lines on stderr, each with its end.
void say_lines(const std::string& text);

/// Prints to stdout. finish_output() checks that it arrived.
void print(const std::string& text);
/// Flushes stdout; fails if something did not arrive (a full disk).
void finish_output();

/// 1234.5 as "1.23 s", 12.34 as "12.3 ms".
std::string readable_ms(double ms);

/// Makes Progress write lines, seconds apart, without a terminal: for a program whose output mpirun captures.
void show_progress_in_lines();

/// A line with the finished share and the remaining time. It is rewritten in place, on a terminal only, and only if the
/// work takes over a second. It is cleared at the end. Only one thread at a time may call update(). If the environment
/// has BIHIVE_PROGRESS=shares, stderr gets lines "bihive: progress: film 0.25" instead, up to ten per second: for
/// packages that run this program.
class Progress {
 public:
  explicit Progress(const std::string& what);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Sets the name of the current work.
  void rename(const std::string& what) { what_ = escaped(what); }
  /// `done`: 0 to 1.
  void update(double done);

 private:
  std::string what_;
  Timer timer_;
  bool terminal_;
  double next_draw_ms_;
  bool drawn_ = false;
};

}  // namespace bihive
