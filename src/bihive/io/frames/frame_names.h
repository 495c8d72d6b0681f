// Texts of spheres over the frames of a file: each name has one number, whatever other names its frame has.
//
// Colours of labels, chains and other texts are those of the numbers, so that they stay in a film.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/io/raw_spheres.h"

namespace bihive {

/// Numbers the names in the order in which they first appear in the file, frame after frame. Where each frame costs
/// reading the whole file, those of the first frame come first, then the frame's own. Any number of threads may use it
/// at a time.
class FrameNames {
 public:
  using ReadFrame = std::function<Result<RawSpheres>(std::int64_t frame)>;

  /// Puts the frame's names into that order, those of other frames between them, and the types that are numbered after
  /// labels. The first frame stays as it is, and of another one a name that the frames before have not shown yet costs
  /// reading these. A frame that cannot be read has no names.
  void put_in_order(std::int64_t frame, RawSpheres& spheres, bool reads_each_apart, const ReadFrame& read);

 private:
  struct Column {
    std::vector<std::string> names;
    std::unordered_map<std::string, std::int32_t> number_of;

    void add(const NamedTexts& texts);
    bool knows_all(const NamedTexts& texts) const;
  };
  void note(const RawSpheres& spheres);
  bool knows_all(const RawSpheres& spheres) const;

  std::mutex lock_;
  std::int64_t noted_ = 0;  // frames, from the first on
  std::unordered_map<std::string, Column> columns_;
};

}  // namespace bihive
