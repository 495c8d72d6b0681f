// Metadata in a picture's file from which the picture can be rendered again and compared. A picture is a function of
// its inputs and of these settings, the same bits on every machine, so the record holds neither threads nor instruction
// sets, times or folders.
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

/// Restores the request of the recorded picture. `folder` is that of the figure, `input` replaces the recorded input
/// unless it is empty. `changes` replace recorded settings; those before a `select` apply to all spheres, and come
/// before the recorded selections. Other files are searched by name in `folder`, then in the current folder. Fails with
/// kBadUsage on a missing file, and as take_setting().
PictureRequest request_again(const PictureRecord& record, const std::string& folder, const std::string& input,
                             const std::vector<GivenSetting>& changes);

/// The options of recorded files (kInputFile among them) whose bytes are others in this request.
std::vector<std::string> changed_files(const PictureRecord& record, const PictureRequest& request);

}  // namespace bihive
