// Where the frames of a text lie in its file, and how a reader passes over them.
#pragma once

#include <cstdint>

#include "bihive/io/column_choice.h"
#include "bihive/io/frames/place_list.h"
#include "bihive/io/packed/random_file.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {

/// A reader needs this of the whole file to read one frame by its bytes alone. Everything in it is places: the
/// bytes themselves stay in the file.
struct FrameIndex {
  PlaceList frames;          ///< one after the other, the first from byte 0 on
  PlaceList assembly_lines;  ///< PDB: runs of REMARK 350
  PlaceList cell_lines;      ///< PDB: each CRYST1
  PlaceList bond_lines;      ///< PDB: runs of CONECT
  bool text_behind = false;  ///< XYZ: text that is no frame follows the last one
  std::int64_t lines = 0;    ///< up to the end of the last frame

  std::int64_t count() const { return static_cast<std::int64_t>(frames.size()); }
};

/// A reader's task with a text: read one frame and pass over the others.
struct FramePass {
  static constexpr std::int64_t kNone = INT64_MIN;

  std::int64_t wanted = 0;     ///< from 0; kNone: all frames are passed over
  std::int64_t first = 0;      ///< the number of the text's first frame
  FrameIndex* made = nullptr;  ///< not null: gets the places of all frames
  /// Not null: the text is the wanted frame's bytes in this file, of which the index is known.
  const FrameIndex* index = nullptr;
  const RandomFile* file = nullptr;
  ColumnChoice columns = {};  ///< of formats with columns

  bool reads_none() const { return wanted == kNone; }
};

/// Notes the places of frames while a reader goes from one to the next.
class FrameNotes {
 public:
  /// The next frame begins where the scanner is.
  FrameNotes(FrameIndex* made, const TextScanner& scanner);
  /// The frame ends behind the scanner's line; there the next one begins.
  void end_frame(const TextScanner& scanner);

 private:
  FrameIndex* made_;
  std::int64_t begin_, lines_before_;
};

}  // namespace bihive
