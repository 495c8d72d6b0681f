// From a file of any known format to a sphere set.
//
// The content tells the format, then the name; gzip is unpacked first. Readers work in binary64 and round once.
// docs/formats.md and SphereFile::rules list what every reader takes and leaves out.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/geometry/sphere_set.h"

namespace bihive {

struct ReadOptions {
  std::optional<double> radius;  ///< replaces every radius; >= 0, world units
  double radius_scale = 1;       ///< multiplies every radius, after `radius`; >= 0
  bool recenter = false;         ///< subtract the middle of the set's centres in binary64 before rounding
  std::int64_t frame = 0;        ///< 0-based frame or model
  std::string assembly = "";     ///< id of a biological assembly in a PDB or mmCIF file; empty: the atoms as they are
};

struct SphereFile {
  SphereSet spheres;                    ///< at least one sphere, in file order
  std::string format;                   ///< "PDB", "mmCIF", "XYZ", "LAMMPS dump", "CSV", "NPY"
  std::int64_t frames = 1;              ///< frames or models in the file
  std::vector<std::string> rules;       ///< what the reader did, a sentence each ("radii: van der Waals, by element")
  std::vector<std::string> warnings;    ///< what the user should know, one line each
  std::vector<std::string> assemblies;  ///< ids of the biological assemblies that the file states
  Vec3d recentred_by;                   ///< subtracted from every centre; 0 without `recenter`
};

/// Never throws. An error names file, and line and column if they are known.
Result<SphereFile> read_spheres(const std::string& path, const ReadOptions& options);

/// The same from bytes in memory; `name` is used for messages and as the second clue to the format.
Result<SphereFile> read_spheres_from_memory(std::string_view bytes, const std::string& name,
                                            const ReadOptions& options);

}  // namespace bihive
