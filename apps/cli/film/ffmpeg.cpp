#include "film/ffmpeg.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "bihive/base/write_file.h"
#include "support/failure.h"

extern char** environ;

namespace bihive::cli {
namespace {

// A pipe whose reader has ended is an error of write(), not a signal: the signal is blocked on this thread, and taken
// back when the write is over.
class NoSigpipe {
 public:
  NoSigpipe() {
    sigemptyset(&pipe_);
    sigaddset(&pipe_, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  ~NoSigpipe() {
    const timespec at_once{};
    while (sigtimedwait(&pipe_, nullptr, &at_once) > 0) {
    }
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  NoSigpipe(const NoSigpipe&) = delete;
  NoSigpipe& operator=(const NoSigpipe&) = delete;

 private:
  sigset_t pipe_{}, before_{};
};

std::string last_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  const std::size_t end = text.rfind('\n');
  return end == std::string::npos ? text : text.substr(end + 1);
}

}  // namespace

std::string find_ffmpeg() {
  const char* const places = std::getenv("PATH");
  std::string rest = places == nullptr ? "/usr/local/bin:/usr/bin:/bin" : places;
  while (!rest.empty()) {
    const std::size_t colon = rest.find(':');
    const std::string folder = rest.substr(0, colon);
    rest = colon == std::string::npos ? "" : rest.substr(colon + 1);
    const std::string path = (folder.empty() ? "." : folder) + "/ffmpeg";
    if (access(path.c_str(), X_OK) == 0) return path;
  }
  fail_environment({"the program ffmpeg, which encodes films, is not installed", "", 0, 0,
                    "install the package ffmpeg, or let the output end in .y4m or be a sequence such as run/%05d.png"});
}

FfmpegRun::FfmpegRun(const std::string& ffmpeg, const std::vector<std::string>& words, std::string log)
    : log_(std::move(log)) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0)
    fail_environment({"no pipe for ffmpeg: " + std::string(std::strerror(errno)), "", 0, 0, ""});
  pipe_ = ends[1];

  // Its streams, a process group of its own, and no signal blocked.
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, ends[0], STDIN_FILENO);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, log_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none, defaults;
  sigemptyset(&none);
  sigemptyset(&defaults);
  sigaddset(&defaults, SIGPIPE);
  sigaddset(&defaults, SIGXFSZ);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &defaults);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);

  std::vector<std::string> all{ffmpeg, "-hide_banner", "-nostdin", "-loglevel", "error", "-y"};
  all.insert(all.end(), words.begin(), words.end());
  std::vector<char*> arguments;
  arguments.reserve(all.size() + 1);
  for (std::string& word : all) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const int code = posix_spawn(&process_, ffmpeg.c_str(), &files, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  close(ends[0]);
  if (code == 0) return;
  process_ = -1;
  close(pipe_);
  pipe_ = -1;
  fail_environment({"cannot be started: " + std::string(std::strerror(code)), ffmpeg, 0, 0, ""});
}

FfmpegRun::~FfmpegRun() {
  end();
}

int FfmpegRun::end() {
  if (pipe_ >= 0) close(pipe_);
  pipe_ = -1;
  int status = 0;
  if (process_ > 0)
    while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
  process_ = -1;
  return status;
}

void FfmpegRun::write(const std::uint8_t* bytes, std::size_t size) {
  const NoSigpipe no_sigpipe;
  while (size > 0) {
    const ssize_t written = ::write(pipe_, bytes, size);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      end();
      fail_with_log("ended too early");
    }
    bytes += written;
    size -= static_cast<std::size_t>(written);
  }
}

void FfmpegRun::finish() {
  const int status = end();
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  fail_with_log(WIFEXITED(status) ? "failed with exit code " + std::to_string(WEXITSTATUS(status))
                                  : "was ended by signal " + std::to_string(WTERMSIG(status)));
}

void FfmpegRun::fail_with_log(const std::string& what) const {
  const Result<std::string> log = read_file(log_);
  const std::string said = log ? last_line(*log) : "";
  fail_environment({"ffmpeg " + what + (said.empty() ? "" : ", and said: " + said), "", 0, 0,
                    "what is encoded already is kept: run the same again when ffmpeg works"});
}

}  // namespace bihive::cli
