// The convention of AMBER for trajectories and restart files in NetCDF [AMBER-NetCDF]. LAMMPS and ASE write it too,
// with more variables for each atom.
#include <algorithm>

#include "bihive/io/formats/arrays/particle_layout.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

// The libraries of NetCDF put this where a number in floating point was never written, in binary32 as in binary64
// [NetCDF].
constexpr double kNetcdfFill = 0x1.ep+122;

// In HDF5 (NetCDF-4) names begin with a slash.
const ArrayFacts* variable_of(const ArrayFile& file, const std::string& name) {
  const ArrayFacts* const found = file.find(name);
  return found != nullptr ? found : file.find("/" + name);
}

bool contains_word(const std::string& text, const char* word) {
  return text.find(word) != std::string::npos;
}

}  // namespace

Result<ParticleLayout> amber_layout(const ArrayFile& file) {
  const std::string convention = file.text("/", "Conventions").value_or("");
  if (!contains_word(convention, "AMBER"))
    return Error{"the NetCDF file holds no atoms after the convention of AMBER, which LAMMPS and ASE follow too",
                 file.path(), 0, 0, "write the places as CSV or .npy, for example with xarray or netCDF4 of Python"};
  ParticleLayout layout;
  layout.format = "AMBER NetCDF";
  layout.warnings = file.warnings();
  const bool is_restart = contains_word(convention, "AMBERRESTART");
  const auto framed = [&](const std::string& name) -> FramedArray {
    const ArrayFacts* const array = variable_of(file, name);
    if (array == nullptr || (!is_restart && array->lengths.empty())) return {};
    return {array, !is_restart, file.number(array->name, "scale_factor").value_or(1),
            file.number(array->name, "_FillValue").value_or(kNetcdfFill)};
  };
  for (const char* const name : {"coordinates", "unwrapped_coordinates"})
    if (!layout.places) layout.places = framed(name);
  if (!layout.places) return Error{"the NetCDF file has no variable 'coordinates'", file.path(), 0, 0, ""};
  const std::vector<std::int64_t> shape = layout.places.lengths();
  if (shape.size() != 2 || shape[1] != 3)
    return Error{"the variable " + quote(layout.places.array->name) + " has not three numbers for each atom",
                 file.path(), 0, 0, ""};
  const double unit = angstrom_of(file.text(layout.places.array->name, "units"));
  layout.places.unit *= unit;
  if (layout.places.array->name.find("unwrapped") != std::string::npos)
    layout.rules.push_back("coordinates: unwrapped");
  if (unit != 1) layout.rules.push_back("lengths: the file's, in Angstrom");

  // The cell.
  layout.lengths = framed("cell_lengths");
  layout.angles = framed("cell_angles");
  layout.corner = framed("cell_origin");
  for (FramedArray* const lengths : {&layout.lengths, &layout.corner})
    if (*lengths) {
      const std::optional<std::string> own = file.text(lengths->array->name, "units");
      lengths->unit *= own ? angstrom_of(own) : unit;
    }

  // Time: AMBER's is in picoseconds, LAMMPS' in units that it may not name.
  if (const FramedArray time = framed("time")) {
    if (const auto picoseconds = picoseconds_of(file.text(time.array->name, "units"))) {
      layout.time_ps = time;
      layout.time_ps.unit *= *picoseconds;
    }
  }

  // Everything else of as many atoms: LAMMPS has id, type, mass and what `dump netcdf` was told.
  for (const ArrayFacts& array : file.arrays()) {
    std::string name = array.name[0] == '/' ? array.name.substr(1) : array.name;
    const FramedArray of = framed(name);
    if (!of || name == "coordinates" || name.rfind("cell_", 0) == 0 || of.array == layout.places.array) continue;
    const std::vector<std::int64_t> lengths = of.lengths();
    if (lengths.empty() || lengths.size() > 2 || lengths[0] != shape[0]) continue;
    if (of.moves && array.lengths[0] != layout.places.array->lengths[0]) continue;
    ParticleColumn column{of, name, {}};
    if (name == "velocities") column.names = {"vx", "vy", "vz"};
    if (name == "forces") column.names = {"fx", "fy", "fz"};
    if (name == "atom_types") column.name = "type";
    layout.columns.push_back(std::move(column));
  }
  return layout;
}

}  // namespace bihive
