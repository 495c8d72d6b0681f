// A film as YUV4MPEG2: pictures without compression, which every program for films reads.
//
// The format has luma and two differences of colour. ITU-R BT.601 with limited range is what programs take where a
// file says nothing else, and the format cannot say it. No sample is left out (C444).

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <utility>

#include "film/film_sink.h"
#include "film/system_failure.h"
#include "support/failure.h"

namespace bihive::cli {
namespace {

constexpr const char* kFrameHead = "FRAME\n";

// Rows of (r, g, b) as three planes. Whole numbers alone: the same bytes everywhere.
std::string planes_of(const PngPixels& pixels) {
  const std::size_t count = static_cast<std::size_t>(pixels.width) * static_cast<std::size_t>(pixels.height);
  std::string bytes(3 * count, '\0');
  for (std::size_t i = 0; i < count; ++i) {
    const int r = pixels.bytes[3 * i], g = pixels.bytes[3 * i + 1], b = pixels.bytes[3 * i + 2];
    bytes[i] = static_cast<char>(16 + ((16829 * r + 33039 * g + 6416 * b + 32768) >> 16));
    bytes[count + i] = static_cast<char>(128 + ((-9714 * r - 19071 * g + 28784 * b + 32767) >> 16));
    bytes[2 * count + i] = static_cast<char>(128 + ((28784 * r - 24103 * g - 4681 * b + 32767) >> 16));
  }
  return bytes;
}

class Y4mFilm final : public FilmSink {
 public:
  Y4mFilm(const FilmPlan& plan, std::string output)
      : output_(std::move(output)), path_(part_path(output_) + "/film.y4m") {
    head_ = fmt::format("YUV4MPEG2 W{} H{} F{}:{} Ip A1:1 C444\n", plan.fixed.width_px, plan.fixed.height_px,
                        plan.asked.rate.pictures, plan.asked.rate.seconds);
    picture_bytes_ = std::int64_t{3} * plan.fixed.width_px * plan.fixed.height_px + 6;
  }

  /// Once, before all others. A failure here leaves no file open.
  void begin() {
    file_ = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file_ < 0) fail_of_system("cannot be written", path_, errno);
    keep_whole_pictures();
  }
  ~Y4mFilm() override {
    if (file_ >= 0) close(file_);
  }

  bool has(std::int64_t number) const override { return number < whole_; }

  void add(const FilmPicture& picture) override {
    write_all(kFrameHead + planes_of(picture.pixels));
    ++whole_;
  }

  void pause() override {}

  void finish() override {
    if (fsync(file_) != 0 || std::rename(path_.c_str(), output_.c_str()) != 0)
      fail_of_system("cannot be written", output_, errno);
  }

 private:
  // The rest behind the last whole picture, left by a killed program, goes away.
  void keep_whole_pictures() {
    struct stat found {};
    if (fstat(file_, &found) != 0) fail_of_system("cannot be read", path_, errno);
    const auto head_bytes = static_cast<std::int64_t>(head_.size());
    whole_ = found.st_size < head_bytes ? 0 : (found.st_size - head_bytes) / picture_bytes_;
    const std::int64_t kept = found.st_size < head_bytes ? 0 : head_bytes + whole_ * picture_bytes_;
    if (ftruncate(file_, kept) != 0 || lseek(file_, 0, SEEK_END) < 0) fail_of_system("cannot be written", path_, errno);
    if (kept == 0) write_all(head_);
  }

  void write_all(const std::string& bytes) {
    std::size_t done = 0;
    while (done < bytes.size()) {
      const ssize_t written = write(file_, bytes.data() + done, bytes.size() - done);
      if (written < 0 && errno != EINTR) fail_of_system("writing failed", path_, errno);
      if (written > 0) done += static_cast<std::size_t>(written);
    }
  }

  std::string output_, path_, head_;
  std::int64_t picture_bytes_ = 0, whole_ = 0;
  int file_ = -1;
};

}  // namespace

std::unique_ptr<FilmSink> open_y4m(const FilmPlan& plan, const std::string& output) {
  auto film = std::make_unique<Y4mFilm>(plan, output);
  film->begin();
  return film;
}

}  // namespace bihive::cli
