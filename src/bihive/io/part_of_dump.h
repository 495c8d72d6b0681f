// A part of a LAMMPS dump: some of its lines.
#pragma once

#include <cstdint>
#include <optional>

#include "bihive/base/result.h"
#include "bihive/geometry/set_parts.h"
#include "bihive/io/packed/random_file.h"
#include "bihive/io/raw_spheres.h"

namespace bihive {

/// The atoms of a file that begins as a dump, no column of which needs all rows (io/text/sphere_table.h), and that is
/// as large as one frame alone makes it. Nothing: parts of it cannot be read.
std::optional<std::int64_t> atoms_in_parts(const RandomFile& file);

/// The atoms whose lines begin in this process' share of the bytes. For all processes at the same time. Errors as those
/// of the reader of the whole file; more or fewer lines than atoms.
Result<RawSpheres> part_of_dump(const RandomFile& file, const SetParts& parts);

}  // namespace bihive
