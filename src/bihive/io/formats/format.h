// A format of files, described once: its names, what shows it, what it has, and how it is read.
//
// Each row stands at the end of its reader's file, and formats.cpp lists all of them. Detection, dispatch, messages,
// --help and the tables of docs/formats.md come from the rows.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <variant>

#include "bihive/base/result.h"
#include "bihive/io/column_choice.h"
#include "bihive/io/frames/frame_index.h"
#include "bihive/io/packed/random_file.h"
#include "bihive/io/raw_spheres.h"
#include "bihive/io/text/text_scanner.h"
#include "bihive/io/trajectory.h"

namespace bihive {

class RawFrames;

/// The beginning of a file, unpacked.
struct FileHead {
  std::string_view bytes;   ///< up to kFileHeadBytes
  const std::string& name;  ///< of the file
  TextScanner text;         ///< formats of text: at the first line that is not empty
};
constexpr std::int64_t kFileHeadBytes = 65536;

// Readers take the whole file, unpacked, and return one frame; `file` is the name for messages, `frame` counts from 0.
// None throws. Errors carry the line, and the column if there is one. docs/formats.md lists what each takes and leaves
// out.

/// One frame, or frames that are found by reading all before it.
using PlainReader = Result<RawSpheres> (*)(std::string_view bytes, const std::string& file, std::int64_t frame);
/// The same, with columns that the user may choose.
using ColumnReader = Result<RawSpheres> (*)(std::string_view bytes, const std::string& file, std::int64_t frame,
                                            const ColumnChoice& columns);
/// Text with many frames, one after the other, from a scanner, which may be that of one window of the file.
using TextReader = Result<RawSpheres> (*)(const TextScanner& text, const FramePass& pass);
/// Frames that lie anywhere in the file. `inside`: a data set of it.
using FramesOpener = Result<std::shared_ptr<const RawFrames>> (*)(RandomFile file, const std::string& inside,
                                                                  const ColumnChoice& columns);

struct Format {
  /// What a format has: lines of text without zero bytes, of which the last has an end; any number of frames; columns
  /// to choose; parts that ranks read each for itself (io/chunk_of_file.h); data sets (FILE:/GROUP/NAME).
  enum Has : unsigned { kText = 1, kFrames = 2, kColumns = 4, kParts = 8, kDataSets = 16 };
  using Recogniser = bool (*)(const FileHead& head);
  using Reader = std::variant<PlainReader, ColumnReader, TextReader, FramesOpener>;

  constexpr Format(std::string_view name_, std::string_view files_, unsigned has, Recogniser recognise_, Reader reader_,
                   std::string_view docs_, std::int64_t index_number_ = -1)
      : name(name_),
        files(files_),
        recognise(recognise_),
        reader(reader_),
        docs(docs_),
        index_number(index_number_),
        has_(has) {}

  std::string_view name;   ///< "LAMMPS dump"
  std::string_view files;  ///< endings of names, before .gz and .zst, or how they begin: ".poscar .vasp poscar*"
  Recogniser recognise;
  Reader reader;
  std::string_view docs;      ///< cells for docs/formats.md: what shows it | what is taken | where radii come from
  std::int64_t index_number;  ///< of a TextReader, in FILE.bihive-index: never another one

  constexpr bool has(Has what) const { return (has_ & what) != 0; }

 private:
  unsigned has_;
};

/// Positions without spheres, which are read beside a file of the spheres.
struct TrajectoryFormat {
  std::string_view name;        ///< "XTC"
  std::string_view files = "";  ///< ".xtc"
  std::string_view alone = "";  ///< "an XTC trajectory of GROMACS"; empty: the format of spheres says it
  std::string_view mark = "";   ///< the first bytes, also of a damaged file
  bool (*recognise)(std::string_view first_bytes) = nullptr;
  Result<std::shared_ptr<const Trajectory>> (*open)(RandomFile file, const std::string& inside) = nullptr;
};

}  // namespace bihive
