// A part of a file's spheres, for sets that lie in several processes.
#pragma once

#include <string>

#include "bihive/base/result.h"
#include "bihive/geometry/set_parts.h"

namespace bihive {

struct RawSpheres;

/// Whether parts of this file can be read: NPY with three or four columns, in C order; GSD, H5MD and LAMMPS dumps of
/// one frame with many particles. Not packed, as it lies on a disk. Other files are read as a whole.
bool can_read_part(const std::string& path);

/// The rows of this process. Part k of n has the rows from about rows * k / n on. For all processes at the same time.
/// Errors as those of the reader of the whole file, and if the processes see files of different shapes, sizes or
/// contents, as far as samples tell.
Result<RawSpheres> read_part(const std::string& path, const SetParts& parts);

}  // namespace bihive
