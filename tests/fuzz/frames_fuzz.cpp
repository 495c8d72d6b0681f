// Files with frames on any bytes: what the index gives is what the reader of the whole file gives, errors included.
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <string>

#include "../support/films.h"
#include "bihive/io/frames.h"
#include "read_and_check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bihive;
  // A file in memory, under a path.
  static const int file = memfd_create("fuzz", MFD_CLOEXEC);
  static const std::string path = "/proc/self/fd/" + std::to_string(file);
  fuzz::require(file >= 0 && ftruncate(file, 0) == 0);
  fuzz::require(pwrite(file, data, size, 0) == static_cast<ssize_t>(size));

  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto expected = [bytes](std::int64_t frame) {
    ReadOptions options;
    options.frame = frame;
    return test::outcome(read_spheres_from_memory(bytes, path, options));
  };
  const Result<std::shared_ptr<const Frames>> frames = open_frames(path, {});
  if (!frames) {
    fuzz::check_error(frames.error());
    fuzz::require("error: " + frames.error().to_string() == expected(0));
    return 0;
  }
  constexpr std::int64_t kMost = 4;
  for (std::int64_t frame = std::min(kMost, (*frames)->count()); frame >= 0; --frame)
    fuzz::require(test::outcome((*frames)->read(frame)) == expected(frame));
  return 0;
}
