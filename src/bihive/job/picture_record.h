// Metadata in a picture's file from which the picture can be rendered again and compared. A picture is a function of
// its inputs and of these settings, the same bits on every machine, so the record holds neither threads nor instruction
// sets, times or folders.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/base/sha256.h"
#include "bihive/image/exr.h"
#include "bihive/job/picture_request.h"

namespace bihive {

/// A file that a picture was made of. `option`: the id of the option that named it, or kInputFile.
struct RecordedFile {
  std::string option;
  std::string name;    ///< without its folder, with the path inside the file: "run.h5:/particles"
  std::string sha256;  ///< empty: unknown
};
inline const std::string kInputFile = "input";

struct PictureRecord {
  std::string version;   ///< of the program
  std::string commit;    ///< the same; empty: unknown
  std::string built_in;  ///< the name of a built-in scene; empty: the input is a file, or was not one
  std::vector<RecordedFile> files;
  std::vector<GivenSetting> settings;  ///< without those that name files
  std::vector<std::string> layers;     ///< of an OpenEXR file; empty: another file
  std::string pixels_sha256;           ///< sha256_of() the pixels; empty: those of a film

  /// A picture of a film: its frame of the input, and what the film fixes.
  std::int64_t frame = 0;
  std::optional<FixedByFilm> fixed{};

  /// A film in one file: its description (JSON), and the SHA-256 of each picture that was drawn, before coding.
  std::string film{};
  std::vector<std::string> pictures_sha256{};
};

/// The name of a file, with the path inside it.
std::string without_folder(const std::string& path);

/// The files of a request by their names and SHA-256. Reads each of them.
std::vector<RecordedFile> files_of_record(const PictureRequest& request);
/// The record of a picture of this request. `files`: those of files_of_record().
PictureRecord record_of(const PictureRequest& request, const std::vector<RecordedFile>& files,
                        std::string pixels_sha256);
/// The same, which reads each file.
PictureRecord record_of(const PictureRequest& request, std::string pixels_sha256);

/// SHA-256 of the numbers of channels, row by row: in each row the channels by rising name, as 32 bits in the order of
/// x86. `rows`: in several calls, each with whole rows of `width` numbers.
class ChannelsHash {
 public:
  void add(const std::vector<Channel>& rows, int width);
  std::string digits() { return sha_.digits(); }

 private:
  Sha256 sha_;
};

/// JSON in one line of ASCII (docs/figures.md), and back. Error: it is no record, or of a later version of the format.
std::string to_text(const PictureRecord& record);
Result<PictureRecord> picture_record_from(std::string_view text);
/// The same JSON with one more member, `settings`: the description of a TIFF file. `settings`: JSON; empty: none.
std::string to_text_with_settings(const PictureRecord& record, const std::string& settings);

/// Restores the request of the recorded picture. `folder` is that of the figure, `input` replaces the recorded input
/// unless it is empty. `changes` replace recorded settings; those before a `select` apply to all spheres, and come
/// before the recorded selections. Other files are searched by name in `folder`, then in the current folder. Fails with
/// kBadUsage on a missing file, on a change of a film's camera, and as take_setting().
PictureRequest request_again(const PictureRecord& record, const std::string& folder, const std::string& input,
                             const std::vector<GivenSetting>& changes);

/// The options of recorded files (kInputFile among them) whose bytes are others in this request.
std::vector<std::string> changed_files(const PictureRecord& record, const PictureRequest& request);

}  // namespace bihive
