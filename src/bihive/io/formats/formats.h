// The formats that are read, and the choice among them: by a file's content, then by its name.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "bihive/io/formats/format.h"

namespace bihive {

/// In the order in which their content is looked for.
std::span<const Format* const> formats();
std::span<const TrajectoryFormat* const> trajectory_formats();

/// The format of that name, which must be there.
const Format& format_named(std::string_view name);

/// The format of unpacked bytes by their content; null if it fits none. Where first lines fit several formats of text,
/// the ending of the name decides.
const Format* format_by_content(std::string_view bytes, const std::string& name);

/// The format by the file's name; null if it fits none.
const Format* format_by_name(const std::string& name);

/// One frame of a whole file in memory.
Result<RawSpheres> read_bytes(const Format& format, std::string_view bytes, const std::string& name, std::int64_t frame,
                              const ColumnChoice& columns = {});

/// "PDB (.pdb .ent), PLY (.ply), ...", for messages.
std::string known_formats();

/// The ending of a file's name, in lower case, before .gz and the like: ".pdb"; empty if it has none.
std::string unpacked_ending_of(const std::string& name);
/// Whether a file's name is one of Format::files.
bool is_named_so(std::string_view files, const std::string& name);

}  // namespace bihive
