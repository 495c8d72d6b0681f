#include "film/ffmpeg.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <limits>
#include <utility>

#include "bihive/base/setting_name.h"
#include "bihive/job/failure.h"
#include "bihive/job/film/system_failure.h"
#include "commands/draw_picture.h"

extern char** environ;

namespace bihive::cli {
namespace {

// After a signal: a run that neither reads nor computes for the first time hangs, and no run may take longer than the
// second.
constexpr double kQuietMs = 1000, kMostMs = 4000;
constexpr int kWaitMs = 20;
// The end of what ffmpeg prints.
constexpr off_t kMostPrinted = 4096;

// The number of the folder in ffmpeg.
constexpr int kFolder = 9;

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

// A file without a name.
Descriptor open_scratch(const OwnFolder& folder) {
  const std::string name = random_part_name();
  std::optional<Descriptor> file = folder.open_file(name, O_RDWR | O_CREAT | O_EXCL);
  if (!file) fail_of_system("cannot be written", folder.path_of(name), ENOENT);
  folder.remove(name);
  return std::move(*file);
}

std::string end_of_file(int file, off_t most) {
  struct stat info {};
  if (fstat(file, &info) != 0) return "";
  std::string text(static_cast<std::size_t>(std::min(info.st_size, most)), '\0');
  const ssize_t got = pread(file, text.data(), text.size(), info.st_size - static_cast<off_t>(text.size()));
  text.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
  return text;
}

void pause_ms(int ms) {
  const timespec time{0, ms * 1'000'000L};
  nanosleep(&time, nullptr);
}

// `status` is that of waitpid().
std::string how_it_ended(int status) {
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return "ended too early";
  if (WIFEXITED(status)) return "failed with exit code " + std::to_string(WEXITSTATUS(status));
  const std::string ended = "was ended by signal " + std::to_string(WTERMSIG(status));
  return WTERMSIG(status) == SIGKILL ? ended + ", as the system does where there is too little memory" : ended;
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
    struct stat info {};
    if (stat(path.c_str(), &info) == 0 && S_ISREG(info.st_mode) && access(path.c_str(), X_OK) == 0) return path;
  }
  fail_environment({"the program ffmpeg, which encodes films, is not installed", "", 0, 0,
                    "install the package ffmpeg, or let the output end in .y4m or be a sequence such as run/%05d.png"});
}

FfmpegRun::FfmpegRun(const std::string& ffmpeg, const std::vector<std::string>& words, const OwnFolder& folder,
                     Input input)
    : folder_(folder), log_(open_scratch(folder)), output_(open_scratch(folder)) {
  std::vector<std::string> all{ffmpeg, "-hide_banner", "-nostdin", "-loglevel", "error", "-y"};
  all.insert(all.end(), words.begin(), words.end());
  if (input == Input::none) {
    const Descriptor nothing(open("/dev/null", O_RDONLY | O_CLOEXEC));
    start(all, nothing.get());
    return;
  }
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0)
    fail_environment({"no pipe for ffmpeg: " + std::string(std::strerror(errno)), "", 0, 0, ""});
  const Descriptor end_of_ffmpeg(ends[0]);
  pipe_ = Descriptor(ends[1]);
  fcntl(pipe_.get(), F_SETFL, O_NONBLOCK);
  start(all, end_of_ffmpeg.get());
}

// Starts it with its streams, its own process group, and no signal blocked.
void FfmpegRun::start(const std::vector<std::string>& words, int input) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&files, output_.get(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&files, log_.get(), STDERR_FILENO);
  posix_spawn_file_actions_adddup2(&files, folder_.descriptor(), kFolder);
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

  std::vector<std::string> copies = words;
  std::vector<char*> arguments;
  arguments.reserve(copies.size() + 1);
  for (std::string& word : copies) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const int code = posix_spawn(&process_, copies.front().c_str(), &files, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  if (code == 0) {
    killed_when_ended_.emplace(process_);
    return;
  }
  process_ = -1;
  fail_environment({"cannot be started: " + std::string(std::strerror(code)), copies.front(), 0, 0, ""});
}

FfmpegRun::~FfmpegRun() {
  if (process_ > 0) kill_all();
}

std::string FfmpegRun::url(const OwnFolder& folder, const std::string& name) {
  static const bool has_links = access("/proc/self/fd", F_OK) == 0;
  return "file:" + (has_links ? "/proc/self/fd/" + std::to_string(kFolder) + "/" + name : folder.path_of(name));
}

// Kills the whole process group: ffmpeg may be a script that has started others.
void FfmpegRun::kill_all() {
  kill(-process_, SIGKILL);
  int status = 0;
  while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  killed_when_ended_.reset();
  process_ = -1;
}

// `got_on`: it has taken bytes. Processor time counts too.
bool FfmpegRun::is_given_up(bool got_on) {
  if (!CancellableSection::token().cancelled()) return false;
  clockid_t clock = 0;
  timespec used{};
  double used_ms = used_ms_;
  if (clock_getcpuclockid(process_, &clock) == 0 && clock_gettime(clock, &used) == 0)
    used_ms = 1e3 * static_cast<double>(used.tv_sec) + 1e-6 * static_cast<double>(used.tv_nsec);
  if (!asked_) asked_.emplace();
  if (!quiet_ || got_on || used_ms > used_ms_ + 1) quiet_.emplace();
  used_ms_ = used_ms;
  return quiet_->elapsed_ms() >= kQuietMs || asked_->elapsed_ms() >= kMostMs;
}

int FfmpegRun::wait_for_end() {
  pipe_ = Descriptor();
  int status = 0;
  for (int ms = 1;; ms = std::min(2 * ms, kWaitMs)) {
    const pid_t ended = waitpid(process_, &status, WNOHANG);
    if (ended == process_ || (ended < 0 && errno != EINTR)) break;
    if (is_given_up(false)) {
      kill_all();
      throw Interrupted{};
    }
    pause_ms(ms);
  }
  killed_when_ended_.reset();
  process_ = -1;
  return status;
}

void FfmpegRun::write(const std::uint8_t* bytes, std::size_t size) {
  const NoSigpipe no_sigpipe;
  while (size > 0) {
    const ssize_t written = ::write(pipe_.get(), bytes, size);
    if (written < 0 && errno != EINTR && errno != EAGAIN) {
      fail_with_log(how_it_ended(wait_for_end()));
    }
    if (is_given_up(written > 0)) {
      kill_all();
      throw Interrupted{};
    }
    if (written < 0) {
      pollfd ready{pipe_.get(), POLLOUT, 0};
      poll(&ready, 1, kWaitMs);
      continue;
    }
    bytes += written;
    size -= static_cast<std::size_t>(written);
  }
}

void FfmpegRun::finish() {
  const int status = wait_for_end();
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  fail_with_log(how_it_ended(status));
}

std::string FfmpegRun::output() const {
  return end_of_file(output_.get(), kMostPrinted);
}

std::string FfmpegRun::whole_output() const {
  return end_of_file(output_.get(), std::numeric_limits<off_t>::max());
}

void FfmpegRun::fail_with_log(const std::string& what) {
  const std::string said = last_line(end_of_file(log_.get(), kMostPrinted));
  fail_environment({"ffmpeg " + what + (said.empty() ? "" : ", and said: " + said), "", 0, 0,
                    "what is encoded already is kept: run the same again when ffmpeg works, or give another " +
                        setting_name("codec")});
}

namespace {

// ffmpeg prints "frame=N" repeatedly; the last one counts. -1: none.
std::int64_t counted(const std::string& ffmpeg, const OwnFolder& folder, const std::string& film, bool decoded) {
  std::vector<std::string> words{"-progress", "pipe:1", "-i", FfmpegRun::url(folder, film), "-map", "0:v:0"};
  if (!decoded) words.insert(words.end(), {"-c", "copy"});
  words.insert(words.end(), {"-f", "null", "-"});
  FfmpegRun run(ffmpeg, words, folder, FfmpegRun::Input::none);
  run.finish();
  constexpr std::string_view kWord = "frame=";
  const std::string said = run.output();
  const std::size_t at = said.rfind(kWord);
  if (at == std::string::npos) return -1;
  const char* const digits = said.c_str() + at + kWord.size();
  char* end = nullptr;
  const long long count = std::strtoll(digits, &end, 10);
  return end == digits || count < 0 ? -1 : static_cast<std::int64_t>(count);
}

}  // namespace

void check_pictures(const std::string& ffmpeg, const OwnFolder& folder, const std::string& film,
                    std::int64_t pictures) {
  // A codec may split a picture into several packets, and hide some; so other numbers are those of decoded pictures.
  std::int64_t found = counted(ffmpeg, folder, film, /*decoded=*/false);
  if (found == pictures) return;
  if (found >= 0) found = counted(ffmpeg, folder, film, /*decoded=*/true);
  if (found == pictures) return;
  const std::string wrote = found < 0 ? "a file that is not a film" : std::to_string(found) + " pictures";
  fail_environment({"ffmpeg was given " + std::to_string(pictures) + " pictures, and wrote " + wrote, "", 0, 0,
                    "remove from " + setting_name("codec") + " what changes the number of pictures, or check that " +
                        ffmpeg + " is really ffmpeg"});
}

}  // namespace bihive::cli
