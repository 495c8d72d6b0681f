// The program ffmpeg, which encodes films.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

namespace bihive::cli {

/// Its path, from the environment's PATH. Fails with kEnvironment if there is none.
std::string find_ffmpeg();

/// One run of ffmpeg that reads from this program. It does not see Ctrl-C: it ends when its input does. What it says
/// goes into a file.
class FfmpegRun {
 public:
  /// `words` follow the program's name. Fails with kEnvironment if it does not start.
  FfmpegRun(const std::string& ffmpeg, const std::vector<std::string>& words, std::string log);
  /// Ends its input, and waits for it.
  ~FfmpegRun();
  FfmpegRun(const FfmpegRun&) = delete;
  FfmpegRun& operator=(const FfmpegRun&) = delete;

  /// Fails with kEnvironment if it has ended: with its own words.
  void write(const std::uint8_t* bytes, std::size_t size);
  /// Ends its input, and waits. Fails with kEnvironment if it was not content.
  void finish();

 private:
  [[noreturn]] void fail_with_log(const std::string& what) const;
  int end();

  pid_t process_ = -1;
  int pipe_ = -1;
  std::string log_;
};

}  // namespace bihive::cli
