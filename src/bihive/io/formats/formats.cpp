#include "bihive/io/formats/formats.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "bihive/base/ascii.h"
#include "bihive/base/check.h"
#include "bihive/base/path_parts.h"
#include "bihive/io/frames/raw_frames.h"
#include "bihive/io/known_formats.h"
#include "bihive/io/packed/unpack.h"

namespace bihive {

// Each row is defined at the end of its reader's file.
extern const Format kNpy, kNpz, kHdf5, kNetcdf, kGsd, kPly, kPcd, kVtk, kVtkXml, kLammpsDump, kSdf, kPoscar, kXdatcar,
    kMol2, kLammpsData, kPsf, kPqr, kPdb, kGro, kXyz, kCsv, kCrystalCif, kMmcif;
extern const TrajectoryFormat kH5mdTrajectory, kAmberTrajectory, kDcd, kXtc, kTrr;

namespace {

constexpr const Format* kFormats[] = {
    // Their first bytes are their own. After a header of text there may be any bytes.
    &kNpy, &kNpz, &kHdf5, &kNetcdf, &kGsd, &kPly, &kVtk, &kPcd, &kVtkXml,
    // Text that no other format has. Titles of these may be anything, also a record of PDB.
    &kLammpsDump, &kSdf, &kPoscar, &kXdatcar, &kMol2, &kLammpsData, &kPsf,
    // Text that is told by its first lines, the special before the general.
    &kPqr, &kPdb, &kGro, &kXyz, &kCsv, &kCrystalCif, &kMmcif};
constexpr const TrajectoryFormat* kTrajectories[] = {&kH5mdTrajectory, &kAmberTrajectory, &kDcd, &kXtc, &kTrr};

// "CSV, GRO and XYZ": in alphabetical order.
std::string listed(std::vector<std::string> all) {
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return lower_case(a) < lower_case(b); });
  std::string list;
  for (std::size_t i = 0; i < all.size(); ++i) list += (i == 0 ? "" : i + 1 == all.size() ? " and " : ", ") + all[i];
  return list;
}

}  // namespace

std::span<const Format* const> formats() {
  return kFormats;
}

std::span<const TrajectoryFormat* const> trajectory_formats() {
  return kTrajectories;
}

const Format& format_named(std::string_view name) {
  const auto found = std::find_if(std::begin(kFormats), std::end(kFormats),
                                  [name](const Format* format) { return format->name == name; });
  BIHIVE_CHECK(found != std::end(kFormats));
  return **found;
}

std::string unpacked_ending_of(const std::string& name) {
  return ending_of(name.substr(0, name.size() - packed_ending(lower_case(name)).size()));
}

bool is_named_so(std::string_view files, const std::string& name) {
  const std::string ending = unpacked_ending_of(name), own = lower_case(name_in_folder(name));
  TextScanner scanner(files, "");
  scanner.next_line();
  for (std::string_view one; scanner.next_field(one);)
    if (one.back() == '*' ? own.rfind(one.substr(0, one.size() - 1), 0) == 0 : one == ending) return true;
  return false;
}

const Format* format_by_name(const std::string& name) {
  // An ending before how a name begins. Data sets may be those of another program: content alone shows them.
  for (const std::string& asked : {unpacked_ending_of(name), name})
    for (const Format* format : kFormats)
      if (!format->has(Format::kDataSets) && is_named_so(format->files, asked)) return format;
  return nullptr;
}

const Format* format_by_content(std::string_view bytes, const std::string& name) {
  bytes = bytes.substr(0, kFileHeadBytes);
  FileHead head{bytes, name, TextScanner(bytes, "")};
  const bool may_be_text = bytes.find('\0') == std::string_view::npos && head.text.next_filled_line();
  const auto fits = [&](const Format* format) {
    return (may_be_text || !format->has(Format::kText)) && format->recognise(head);
  };
  const auto found = std::find_if(std::begin(kFormats), std::end(kFormats), fits);
  if (found == std::end(kFormats)) return nullptr;

  // First lines may be those of two formats. One reader takes all CIF.
  const auto first_general = std::find(std::begin(kFormats), std::end(kFormats), &kPqr);
  const bool is_general = found >= first_general && !(*found)->files.empty();
  const Format* const named = is_general ? format_by_name(name) : nullptr;
  return named != nullptr && fits(named) ? named : *found;
}

Result<RawSpheres> read_bytes(const Format& format, std::string_view bytes, const std::string& name, std::int64_t frame,
                              const ColumnChoice& columns) {
  if (const auto* read = std::get_if<PlainReader>(&format.reader)) return (*read)(bytes, name, frame);
  if (const auto* read = std::get_if<ColumnReader>(&format.reader)) return (*read)(bytes, name, frame, columns);
  if (const auto* read = std::get_if<TextReader>(&format.reader)) {
    FramePass pass{frame};
    pass.columns = columns;
    return (*read)(TextScanner(bytes, name), pass);
  }
  const FramesOpener open = std::get<FramesOpener>(format.reader);
  const Result<std::shared_ptr<const RawFrames>> frames = open(RandomFile::of_bytes(bytes, name), "", columns);
  if (!frames) return frames.error();
  return (*frames)->read(frame);
}

std::string known_formats() {
  std::vector<std::string> all;
  for (const Format* format : kFormats)
    all.push_back(std::string(format->name) + (format->files.empty() ? "" : " (" + std::string(format->files) + ")"));
  return listed(std::move(all)) + ", each also as .gz, .zst, .xz or .bz2";
}

std::string names_of_formats(FormatsThat which) {
  std::vector<std::string> names;
  if (which == FormatsThat::are_trajectories)
    for (const TrajectoryFormat* format : kTrajectories) names.emplace_back(format->name);
  else
    for (const Format* format : kFormats)
      if (which == FormatsThat::hold_spheres || format->has(Format::kColumns)) names.emplace_back(format->name);
  return listed(std::move(names));
}

}  // namespace bihive
