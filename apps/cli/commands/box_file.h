// Files of boxes for `bihive compare --boxes`: CSV, and geometries in the JSON of Celeritas' ORANGE.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bihive/compare/box_queries.h"

namespace bihive::cli {

struct BoxFile {
  std::vector<workbench::Box> boxes;
  std::string universe;          ///< ORANGE: its name, or its position where it has none; else empty
  std::int64_t without_box = 0;  ///< ORANGE: volumes of the universe whose box is not stated or not finite
};

/// CSV: a box in a line, xmin,ymin,zmin,xmax,ymax,zmax, after a line of these names or none; # begins a comment. ORANGE
/// (a file that begins with {): the boxes of the volumes of one universe, `bbox` [[x, y, z], [x, y, z]], in the
/// universe's coordinates. `universe`: its name (`md`.`name`) or its position from 0; empty: the first one, which has
/// the others inside. Fails with kBadInput, and with kBadUsage for a universe of a file that has none.
BoxFile read_box_file(const std::string& path, const std::string& universe);

}  // namespace bihive::cli
