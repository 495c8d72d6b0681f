// Stands in for libFuzzer where the fuzz targets only have to take the inputs of folders, by the library as users get
// it.
//
//   replay TARGET FOLDER...
//     Each input once. Prints the name of each before it is tried, so that the last one is the one that failed.
//   replay TARGET FOLDER... --random COUNT SEED
//     COUNT inputs more: one of these or parts of several, changed at random. It knows nothing of the code that they
//     reach, but is many times faster than a fuzzer with sanitizers. An input that fails is left in the file
//     failed-SEED-PROCESS.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bihive/math/rng.h"

using Target = int (*)(const std::uint8_t* data, std::size_t size);

// fuzz_targets.inc, which CMake writes, has a line FUZZ_TARGET(NAME) for each file NAME_fuzz.cpp. The function of the
// file is called fuzz_NAME here.
#define FUZZ_TARGET(name) extern "C" int fuzz_##name(const std::uint8_t* data, std::size_t size);
#include "fuzz_targets.inc"
#undef FUZZ_TARGET

namespace {

struct NamedTarget {
  std::string_view name;
  Target run;
};

#define FUZZ_TARGET(name) {#name, fuzz_##name},
constexpr NamedTarget kTargets[] = {
#include "fuzz_targets.inc"
};
#undef FUZZ_TARGET

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t kMostBytes = 2048;
constexpr unsigned kPatienceS = 60;  // for a thousand inputs

class Random {
 public:
  explicit Random(std::uint64_t seed) : numbers_(seed) {}
  std::uint64_t next() { return numbers_.next(); }
  /// 0 to count - 1; 0 for none.
  std::size_t below(std::size_t count) { return count == 0 ? 0 : static_cast<std::size_t>(numbers_.next_below(count)); }

 private:
  bihive::SplitMix64 numbers_;
};

constexpr std::string_view kWords[] = {"0",     "-1", "1e39", "-0", "nan", "inf", "4294967296", "9223372036854775807",
                                       "1e-46", "\n", "\r\n", " ",  ",",   "\"",  "{",          "}",
                                       "[",     "(",  "'",    "\t"};

// One small change.
void change(Bytes& bytes, const std::vector<Bytes>& seeds, Random& random) {
  const std::size_t at = random.below(bytes.size() + 1);
  const auto place = bytes.begin() + static_cast<std::ptrdiff_t>(at);
  const std::size_t count = std::min(bytes.size() - at, 1 + random.below(random.below(4) == 0 ? 64 : 4));
  const auto end = place + static_cast<std::ptrdiff_t>(count);
  switch (random.below(9)) {
    case 0:
      if (at < bytes.size()) bytes[at] ^= static_cast<std::uint8_t>(1U << random.below(8));
      return;
    case 1:
      if (at < bytes.size()) bytes[at] = static_cast<std::uint8_t>(random.next());
      return;
    case 2:
      for (auto i = place; i != end; ++i) *i = random.below(2) == 0 ? 0 : 0xFF;
      return;
    case 3:
      bytes.erase(place, end);
      return;
    case 4: {  // once more, elsewhere
      const Bytes part(place, end);
      bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(random.below(bytes.size() + 1)), part.begin(),
                   part.end());
      return;
    }
    case 5: {
      const std::string_view word = kWords[random.below(std::size(kWords))];
      bytes.insert(random.below(2) == 0 ? place : bytes.erase(place, end), word.begin(), word.end());
      return;
    }
    case 6: {  // a part of another input
      const Bytes& other = seeds[random.below(seeds.size())];
      const std::size_t first = random.below(other.size() + 1), length = random.below(other.size() - first + 1);
      bytes.insert(place, other.begin() + static_cast<std::ptrdiff_t>(first),
                   other.begin() + static_cast<std::ptrdiff_t>(first + length));
      return;
    }
    case 7:  // a digit is another
      for (std::size_t i = at; i < bytes.size(); ++i)
        if (bytes[i] >= '0' && bytes[i] <= '9') {
          bytes[i] = static_cast<std::uint8_t>('0' + random.below(10));
          return;
        }
      return;
    default:
      if (random.below(8) == 0) bytes.resize(at);
  }
}

// For the handler of signals: the input on trial.
const Bytes* on_trial = nullptr;
char name_of_failed[64];

void keep_input(int number) {
  const int file = open(name_of_failed, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file >= 0 && on_trial != nullptr) {
    const ssize_t ignored = write(file, on_trial->data(), on_trial->size());
    static_cast<void>(ignored);
    close(file);
  }
  std::signal(number, SIG_DFL);
  std::raise(number);
}

void run_random(Target target, const std::vector<Bytes>& seeds, std::uint64_t count, std::uint64_t seed) {
  std::snprintf(name_of_failed, sizeof name_of_failed, "failed-%llu-%d", static_cast<unsigned long long>(seed),
                static_cast<int>(getpid()));
  for (const int number : {SIGABRT, SIGSEGV, SIGFPE, SIGBUS, SIGILL, SIGALRM}) std::signal(number, keep_input);
  Random random(seed);
  const auto begin = std::chrono::steady_clock::now();
  Bytes bytes;
  on_trial = &bytes;
  for (std::uint64_t i = 0; i < count; ++i) {
    if (i % 1000 == 0) alarm(kPatienceS);
    bytes = seeds[random.below(seeds.size())];
    for (std::size_t changes = 1 + random.below(6); changes > 0; --changes) change(bytes, seeds, random);
    if (bytes.size() > kMostBytes) bytes.resize(kMostBytes);
    target(bytes.data(), bytes.size());
  }
  alarm(0);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  std::printf("%llu executions in %.1f s\n", static_cast<unsigned long long>(count), seconds.count());
}

}  // namespace

int main(int count, char** arguments) {
  const bool is_random = count > 4 && std::string_view(arguments[count - 3]) == "--random";
  const int folders_end = is_random ? count - 3 : count;
  const std::string_view name = count > 1 ? arguments[1] : "";
  const auto target =
      std::find_if(std::begin(kTargets), std::end(kTargets), [&](const NamedTarget& one) { return one.name == name; });
  std::vector<std::filesystem::path> files;
  for (int i = 2; i < folders_end; ++i)
    for (const auto& entry : std::filesystem::directory_iterator(arguments[i])) files.push_back(entry.path());
  if (target == std::end(kTargets) || files.empty()) {
    std::fprintf(stderr,
                 "usage: replay TARGET FOLDER... [--random COUNT SEED], with inputs in the folders. Targets:\n");
    for (const NamedTarget& one : kTargets) std::fprintf(stderr, "  %s\n", one.name.data());
    return 2;
  }
  std::sort(files.begin(), files.end());
  std::vector<Bytes> seeds;
  for (const std::filesystem::path& file : files) {
    std::ifstream in(file, std::ios::binary);
    Bytes bytes{std::istreambuf_iterator<char>(in), {}};
    if (!is_random) {
      std::printf("%s\n", file.c_str());
      std::fflush(stdout);
      target->run(bytes.data(), bytes.size());
    }
    seeds.push_back(std::move(bytes));
  }
  if (is_random)
    run_random(target->run, seeds, std::strtoull(arguments[count - 2], nullptr, 10),
               std::strtoull(arguments[count - 1], nullptr, 10));
}
