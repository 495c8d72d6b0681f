// What the file of a picture says of how it was made, so that the picture can be drawn again and compared. A picture is
// a function of its inputs and of these settings, the same bits on every machine; so the record holds neither threads
// nor instruction sets, times or folders.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bihive/base/result.h"
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
  std::string pixels_sha256;           ///< of the bytes of PngPixels
};

/// The record of a picture of this request. Reads each file once more.
PictureRecord record_of(const PictureRequest& request, std::string pixels_sha256);

/// JSON in one line of ASCII (docs/figures.md), and back. Error: it is no record, or of a later version of the format.
std::string to_text(const PictureRecord& record);
Result<PictureRecord> picture_record_from(std::string_view text);

/// The request for the recorded picture. `folder`: where the figure lies. `changes`: settings in place of recorded
/// ones; what comes before a `select` acts on all spheres, and before the recorded selections. `input`: in place of the
/// recorded one; empty: that. Files that nobody names are looked for by their names, in `folder` and in the current
/// one. Fails with kBadUsage on a file that is not there, and as take_setting().
PictureRequest request_again(const PictureRecord& record, const std::string& folder, const std::string& input,
                             const std::vector<GivenSetting>& changes);

/// The options of recorded files (kInputFile among them) whose bytes are others in this request.
std::vector<std::string> changed_files(const PictureRecord& record, const PictureRequest& request);

/// Whether the value of this setting is a path.
bool names_file(std::string_view id, const std::string& value);

}  // namespace bihive
