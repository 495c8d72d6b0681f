// Finds the format of a file: by its content, then by its name.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace bihive {

enum class Format {
  pdb,
  pqr,
  mmcif,
  xyz,
  gro,
  lammps_dump,
  lammps_data,
  poscar,
  xdatcar,
  sdf,
  mol2,
  small_cif,
  ply,
  pcd,
  vtk_legacy,
  vtk_xml,
  gsd,
  csv,
  npy,
  npz,
  hdf5,
  netcdf
};

/// The format of unpacked bytes by their content; nothing if it fits none, or several. Where PDB and PQR both fit, the
/// ending of the name decides.
std::optional<Format> format_by_content(std::string_view bytes, const std::string& name);

/// The format by the ending of the name (without .gz).
std::optional<Format> format_by_name(const std::string& name);

/// The known formats and their endings, for messages.
std::string known_formats();

}  // namespace bihive
