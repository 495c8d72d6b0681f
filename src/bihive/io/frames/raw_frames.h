// The frames of one file as its reader finds them, before the steps that all formats share.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/io/column_choice.h"
#include "bihive/io/raw_spheres.h"

namespace bihive {

/// Any number of threads may read at a time.
class RawFrames {
 public:
  virtual ~RawFrames() = default;

  /// Errors: those of the reader; no such frame; the file changed meanwhile.
  virtual Result<RawSpheres> read(std::int64_t frame) const = 0;
  /// Whether a frame is read by its own bytes, so that reading all frames costs one pass over the file.
  virtual bool reads_each_apart() const { return true; }
  /// A file of text whose last line has no end.
  bool may_be_cut() const { return may_be_cut_; }
  /// As Frames::warnings().
  const std::vector<std::string>& warnings() const { return warnings_; }

 protected:
  void warn(const std::string& warning) { warnings_.push_back(warning); }
  void set_may_be_cut(bool may_be_cut) { may_be_cut_ = may_be_cut; }

 private:
  std::vector<std::string> warnings_;
  bool may_be_cut_ = false;
};

struct OpenedFrames {
  std::shared_ptr<const RawFrames> frames;
  RawSpheres wanted;  ///< the frame that was asked for
};

/// Finds the format, and reads the frame on the way past all frames. Of text with many frames, one window lies in
/// memory at a time, and later reads take the frame's bytes alone. Files of one frame and mmCIF are read as a whole.
/// Errors: those of the format's reader for the whole file.
/// `keep_index`: as in FramesOptions.
Result<OpenedFrames> open_raw_frames(const std::string& path, std::int64_t wanted, bool keep_index = false,
                                     const ColumnChoice& columns = {});

/// The same from bytes that must outlive it.
Result<OpenedFrames> open_raw_frames(std::string_view bytes, const std::string& name, std::int64_t wanted,
                                     const ColumnChoice& columns = {});

}  // namespace bihive
