#include "bihive/io/frames.h"

#include <utility>

namespace bihive {
namespace {

// Reads the whole file for each frame.
class WholeFile : public Frames {
 public:
  WholeFile(std::string path, ReadOptions options, std::int64_t count)
      : path_(std::move(path)), options_(std::move(options)), count_(count) {}

  std::int64_t count() const override { return count_; }

  Result<SphereFile> read(std::int64_t frame) const override {
    ReadOptions options = options_;
    options.frame = frame;
    return read_spheres(path_, options);
  }

 private:
  std::string path_;
  ReadOptions options_;
  std::int64_t count_;
};

}  // namespace

Result<std::shared_ptr<const Frames>> open_frames(const std::string& path, const ReadOptions& options) {
  ReadOptions first = options;
  first.frame = 0;
  const Result<SphereFile> read = read_spheres(path, first);
  if (!read) return read.error();
  return std::shared_ptr<const Frames>(std::make_shared<WholeFile>(path, options, read->frames));
}

}  // namespace bihive
