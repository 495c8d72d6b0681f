// Writes TIFF (libtiff): pictures for print.
#pragma once

#include <memory>
#include <string>

#include "bihive/base/result.h"
#include "bihive/image/png_pixels.h"

namespace bihive {

struct TiffForm {
  int width = 0, height = 0, channels = 3, bits = 8;  ///< of the whole picture, as in PngPixels
  double dots_per_inch = 0;                           ///< 0: not said
  std::string software, description;                  ///< texts of the file; empty: none
};

/// Whether this library was built with libtiff. Without it, begin() and write_tiff() return an Error that says so.
bool can_write_tiff();

/// A file that grows by rows, for pictures that are larger than the memory: RGB, or RGB with straight opacity, in
/// strips compressed by Deflate without loss; BigTIFF above 4 GB. Equal rows give equal bytes; there is no date in the
/// file.
class TiffWriter {
 public:
  /// The file lies beside its path until finish() (base/write_file.h). A pipe cannot hold TIFF.
  static Result<TiffWriter> begin(const std::string& path, const TiffForm& form);
  TiffWriter(TiffWriter&& other) noexcept;
  TiffWriter& operator=(TiffWriter&& other) noexcept;
  /// A file that is not finished is removed.
  ~TiffWriter();

  /// The next rows, of the width, channels and bits of the form.
  Status add(const PngPixels& rows);
  /// After the last row. `description`: in place of the form's, for what is known only now; empty: that stays.
  Status finish(const std::string& description = "");
  std::string path_aside() const;  ///< as of GrowingFile

 private:
  class Implementation;
  explicit TiffWriter(std::unique_ptr<Implementation> implementation);
  std::unique_ptr<Implementation> implementation_;
};

/// The whole file.
Status write_tiff(const std::string& path, const TiffForm& form, const PngPixels& pixels);

/// The pixels of a file that TiffWriter made, as they are, and its description. Error: it has another form.
struct TiffFile {
  PngPixels pixels;
  std::string description;
};
Result<TiffFile> read_tiff(const std::string& path);

}  // namespace bihive
