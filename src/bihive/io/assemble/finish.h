// The part that all readers share: from a file's numbers to a sphere set.
#pragma once

#include <string>

#include "bihive/base/result.h"
#include "bihive/io/raw_spheres.h"
#include "bihive/io/read_spheres.h"

namespace bihive {

/// Gives radii to spheres without radii (io/assemble/unknown_radii.h), applies the options, and rounds once. `name` is
/// the file's, for messages. Errors: no spheres; a number that is not finite, out of range, or a negative radius.
Result<SphereFile> finish_spheres(RawSpheres raw, const std::string& name, const ReadOptions& options);

}  // namespace bihive
