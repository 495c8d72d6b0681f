// The program ffmpeg, which encodes films.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bihive/base/timer.h"
#include "bihive/job/film/own_folder.h"
#include "support/interrupt.h"

namespace bihive::cli {

/// Its path, from the environment's PATH. Fails with kEnvironment if there is none.
std::string find_ffmpeg();

/// One run of ffmpeg in a folder of a film. It does not see Ctrl-C: it ends when its input does. After a signal to this
/// program a run without progress for a second is ended, and so is one that takes four.
class FfmpegRun {
 public:
  enum class Input { none, pictures };

  /// `words`: the arguments after the program's name. `folder` must outlive the run. Fails with kEnvironment if it does
  /// not start.
  FfmpegRun(const std::string& ffmpeg, const std::vector<std::string>& words, const OwnFolder& folder, Input input);
  /// Ends it at once if it still runs.
  ~FfmpegRun();
  FfmpegRun(const FfmpegRun&) = delete;
  FfmpegRun& operator=(const FfmpegRun&) = delete;

  /// The name of a file in the folder for `words`, valid even if the folder is renamed.
  static std::string url(const OwnFolder& folder, const std::string& name);

  /// Fails with kEnvironment if it has ended, with its own message. Throws Interrupted if it was ended after a signal.
  void write(const std::uint8_t* bytes, std::size_t size);
  /// Ends its input, and waits. Fails with kEnvironment if it failed. Throws Interrupted as write() does.
  void finish();
  /// The end of its output, at most 4 kB.
  std::string output() const;
  std::string whole_output() const;

 private:
  [[noreturn]] void fail_with_log(const std::string& what);
  void start(const std::vector<std::string>& words, int input);
  bool is_given_up(bool got_on);
  void kill_all();
  int wait_for_end();

  const OwnFolder& folder_;
  pid_t process_ = -1;
  Descriptor pipe_, log_, output_;
  std::optional<KilledWhenEnded> killed_when_ended_;
  // After a signal.
  std::optional<Timer> asked_, quiet_;
  double used_ms_ = 0;
};

/// Fails with kEnvironment unless ffmpeg finds this number of pictures in a film that it has written.
void check_pictures(const std::string& ffmpeg, const OwnFolder& folder, const std::string& film, std::int64_t pictures);

}  // namespace bihive::cli
