// A film as YUV4MPEG2: pictures without compression, which every program for films reads.
//
// The format has luma and two differences of colour. Programs assume ITU-R BT.601 with limited range, which the format
// cannot state. Colours are not subsampled (C444).

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "bihive/job/failure.h"
#include "bihive/job/film/system_failure.h"
#include "commands/draw_picture.h"
#include "film/film_folder.h"
#include "film/film_sink.h"
#include "support/interrupt.h"

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

constexpr const char* kName = "film.y4m";

class Y4mFilm final : public FilmSink {
 public:
  Y4mFilm(const FilmPlan& plan, FilmFolder& film)
      : film_(film), order_(plan.asked.order), pictures_(plan.asked.pictures) {
    head_ = fmt::format("YUV4MPEG2 W{} H{} F{}:{} Ip A1:1 C444\n", plan.fixed.width_px, plan.fixed.height_px,
                        plan.asked.rate.pictures, plan.asked.rate.seconds);
    picture_bytes_ = std::int64_t{3} * plan.fixed.width_px * plan.fixed.height_px + 6;
    if (film_.existing() != nullptr) begin(*film_.existing());
  }

  bool has(std::int64_t number) const override { return number < whole_; }

  void add(const FilmPicture& picture) override {
    if (!file_) {
      const OwnFolder& folder = film_.folder();
      film_.note_file(kName);
      begin(folder);
    }
    write_all(kFrameHead + planes_of(picture.pixels));
    ++whole_;
    film_.keep();
    repeat();
  }

  void pause() override {}

  void finish() override {
    if (!file_) begin(film_.folder());
    if (const int code = flush_to_disk(file_.get()); code != 0) fail_of_system("writing failed", path_, code);
    film_.finish(kName);
  }

 private:
  // Created with the same mode as ffmpeg's files; the folder is private.
  void begin(const OwnFolder& folder) {
    path_ = folder.path_of(kName);
    folder.write_new(kName, "", kOfOutputs);
    std::optional<Descriptor> file = folder.open_file(kName, O_RDWR);
    if (!file) fail_of_system("cannot be written", path_, ENOENT);
    file_ = std::move(*file);
    keep_whole_pictures();
    repeat();
  }

  // Truncate what a killed program left after the last whole picture.
  void keep_whole_pictures() {
    struct stat found {};
    if (fstat(file_.get(), &found) != 0) fail_of_system("cannot be read", path_, errno);
    const auto head_bytes = static_cast<std::int64_t>(head_.size());
    whole_ = found.st_size < head_bytes ? 0 : (found.st_size - head_bytes) / picture_bytes_;
    const std::int64_t kept = found.st_size < head_bytes ? 0 : head_bytes + whole_ * picture_bytes_;
    if (ftruncate(file_.get(), kept) != 0 || lseek(file_.get(), 0, SEEK_END) < 0)
      fail_of_system("cannot be written", path_, errno);
    if (kept == 0) write_all(head_);
  }

  // Copies the pictures that are shown again next.
  void repeat() {
    for (; whole_ < order_.positions(pictures_); ++whole_) {
      const std::int64_t first = order_.first_position(whole_, pictures_);
      if (first == whole_) return;
      if (CancellableSection::token().cancelled()) throw Interrupted{};
      write_all(frame(first));
    }
  }

  // The bytes of a whole frame.
  std::string frame(std::int64_t position) const {
    std::string bytes(static_cast<std::size_t>(picture_bytes_), '\0');
    const off_t begin = static_cast<off_t>(head_.size()) + position * picture_bytes_;
    for (std::size_t done = 0; done < bytes.size();) {
      const ssize_t count =
          pread(file_.get(), bytes.data() + done, bytes.size() - done, begin + static_cast<off_t>(done));
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) fail_of_system("cannot be read", path_, count < 0 ? errno : EIO);
      done += static_cast<std::size_t>(count);
    }
    return bytes;
  }

  void write_all(const std::string& bytes) {
    if (const int code = write_whole(file_.get(), bytes); code != 0) fail_of_system("writing failed", path_, code);
  }

  FilmFolder& film_;
  PictureOrder order_;
  std::int64_t pictures_;
  std::string path_, head_;
  std::int64_t picture_bytes_ = 0, whole_ = 0;
  Descriptor file_;
};

}  // namespace

std::unique_ptr<FilmSink> open_y4m(const FilmPlan& plan, FilmFolder& film) {
  return std::make_unique<Y4mFilm>(plan, film);
}

}  // namespace bihive::cli
