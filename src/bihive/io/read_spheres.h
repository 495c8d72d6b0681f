// From a file of any known format to a sphere set.
//
// The content tells the format, then the name; gzip is unpacked first. Readers work in binary64 and round once.
// docs/formats.md and SphereFile::rules list what every reader takes and leaves out.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/io/column_choice.h"

namespace bihive {

/// Where spheres of a periodic cell go. wrap: each centre moves by whole vectors of the cell into the cell. unwrap:
/// spheres that belong together come together (docs/formats.md). wrap_molecules: they come together, and all move by
/// the same vectors, so that their middle is in the cell.
enum class Wrapping { none, wrap, unwrap, wrap_molecules };

struct ReadOptions {
  std::optional<double> radius;  ///< replaces every radius; >= 0, world units
  double radius_scale = 1;       ///< multiplies every radius, after `radius`; >= 0
  bool recenter = false;         ///< subtract the middle of the set's centres in binary64 before rounding
  std::int64_t frame = 0;        ///< 0-based frame or model; less than 0 counts from the end, -1 is the last
  /// A file with the places of the same spheres (io/trajectory.h), of which `frame` is then a frame; the other file is
  /// read at its first frame. Empty: none.
  std::string trajectory = "";
  std::int64_t smooth = 1;    ///< an odd number: coordinates are means over this many frames (io/frames/frame_means.h)
  std::string assembly = "";  ///< id of a biological assembly in a PDB or mmCIF file; empty: the atoms as they are
  ColumnChoice columns = {};  ///< of formats with columns: which one plays which part; the others go by their names
  /// The vectors of the cell and its corner, in place of the file's. A corner that neither states is 0.
  std::optional<std::array<Vec3d, 3>> cell_vectors;
  std::optional<Vec3d> cell_origin;
  std::optional<std::array<bool, 3>> cell_periodic;  ///< Cell::periodic, in place of the file's
  bool periodic = true;                              ///< distances know the cell's images; false: Cell::periodic is not
  Wrapping wrapping = Wrapping::none;                ///< needs a cell
  /// Adds the column exposed_area (docs/measures.md), for a probe of this radius >= 0 in world units.
  std::optional<double> exposed_area;
  bool exposed_area_periodic = false;              ///< in it, the cell's images cover spheres too
  std::array<std::int32_t, 3> replicate{1, 1, 1};  ///< copies along the cell's vectors (SphereSet::replicate)
};

/// How the warning begins where SphereFile::assumed_radii.
constexpr std::string_view kNoRadii = "no radii; each sphere";

struct SphereFile {
  SphereSet spheres;   ///< at least one sphere, in file order or by id (docs/formats.md)
  std::string format;  ///< "PDB", "PQR", "mmCIF", "XYZ", "GRO", "LAMMPS dump", "GSD", "CSV", "NPY"
  /// What the file says that it shows, of the frame where frames have titles: one line of at most 300 bytes, without
  /// control characters; empty if it says nothing.
  std::string title;
  std::string entry_id;                 ///< the entry of a database, such as "1HPV"; empty if the file states none
  std::int64_t frames = 1;              ///< frames or models in the file
  std::vector<std::string> rules;       ///< what the reader did, a sentence each ("radii: van der Waals, by element")
  std::vector<std::string> warnings;    ///< what the user should know, one line each
  std::vector<std::string> assemblies;  ///< ids of the biological assemblies that the file states
  std::optional<double> time_ps;        ///< of the frame, picoseconds, where the file states it
  std::optional<std::int64_t> step;     ///< of the simulation, where the file states it
  bool assumed_radii = false;           ///< the file states none, and no sphere has a known element: all are equal
  Vec3d recentred_by;                   ///< subtracted from every centre; 0 without `recenter`
};

/// Never throws. An error names file, and line and column if they are known.
Result<SphereFile> read_spheres(const std::string& path, const ReadOptions& options);

/// The bytes themselves, or what they hold if they are packed with gzip or zstd. Errors: damaged, or more than the
/// memory holds (base/memory.h). `name` is for messages.
Result<std::string> unpack_if_packed(std::string bytes, const std::string& name);

/// The same from bytes in memory; `name` is used for messages and as the second clue to the format. A trajectory is
/// still a file.
Result<SphereFile> read_spheres_from_memory(std::string_view bytes, const std::string& name,
                                            const ReadOptions& options);

}  // namespace bihive
