// Writes OpenEXR: pictures of unlimited light, with any number of further channels.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/image/film.h"

namespace bihive {

/// The numbers of one channel, row by row from the top: of binary32, or ids.
struct Channel {
  std::string name;  ///< "R", or with its layer "albedo.R"; 1 to 255 bytes
  bool of_ids = false;
  std::vector<float> numbers;      ///< empty if of_ids
  std::vector<std::uint32_t> ids;  ///< empty unless of_ids
};

struct ExrForm {
  int width_px = 0, height_px = 0;  ///< of the whole picture: the display window
  Tile pixels{};                    ///< those that the file holds, inside the picture: the data window
  std::vector<Channel> channels;    ///< names and types; their numbers do not count here. No name stands twice.
  /// Attributes of the file: name and text (UTF-8).
  std::vector<std::pair<std::string, std::string>> text;
  double dots_per_inch = 0;  ///< 0: not said
};

/// Whether this library was built with OpenEXR. Without it, begin() and write_exr() return an Error that says so.
bool can_write_exr();

/// A file that grows by rows, for pictures that are larger than the memory. Scan lines from the top, compressed by ZIP
/// without loss, light with the primaries of sRGB. Equal rows give equal bytes; there is no date in the file.
class ExrWriter {
 public:
  /// The file lies beside its path until finish() (base/write_file.h). A pipe cannot hold OpenEXR.
  static Result<ExrWriter> begin(const std::string& path, const ExrForm& form);
  ExrWriter(ExrWriter&& other) noexcept;
  ExrWriter& operator=(ExrWriter&& other) noexcept;
  /// A file that is not finished is removed.
  ~ExrWriter();

  /// The next rows. The channels are those of the form, in the same order, each with whole rows.
  Status add(const std::vector<Channel>& channels);
  /// After the last row.
  Status finish();
  /// Replaces `before` where it stands last in the texts of the form, by a text of the same length: for what is known
  /// only after the pixels. Before finish().
  Status replace_text(const std::string& before, const std::string& after);
  std::string path_aside() const;  ///< as of GrowingFile

 private:
  class Implementation;
  explicit ExrWriter(std::unique_ptr<Implementation> implementation);
  std::unique_ptr<Implementation> implementation_;
};

/// The whole file: form.channels hold the numbers.
Status write_exr(const std::string& path, const ExrForm& form);

/// A file of numbers of 32 bits in scan lines, as ExrWriter makes it; channels by rising name. Error: it cannot be
/// read, or has another form.
Result<ExrForm> read_exr(const std::string& path);

}  // namespace bihive
