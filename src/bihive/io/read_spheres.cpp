#include "bihive/io/read_spheres.h"

#include <algorithm>
#include <exception>

#include "bihive/base/write_file.h"
#include "bihive/io/detect.h"
#include "bihive/io/finish.h"
#include "bihive/io/foreign.h"
#include "bihive/io/gunzip.h"
#include "bihive/io/readers.h"
#include "bihive/io/text_scanner.h"
#include "bihive/io/trajectory.h"
#include "bihive/io/unknown_radii.h"

namespace bihive {
namespace {

Result<RawSpheres> read_format(Format format, std::string_view bytes, const std::string& name, std::int64_t frame) {
  switch (format) {
    case Format::pdb:
      return read_pdb(bytes, name, frame);
    case Format::pqr:
      return read_pqr(bytes, name, frame);
    case Format::mmcif:
      return read_mmcif(bytes, name, frame);
    case Format::xyz:
      return read_xyz(bytes, name, frame);
    case Format::gro:
      return read_gro(bytes, name, frame);
    case Format::lammps_dump:
      return read_lammps_dump(bytes, name, frame);
    case Format::lammps_data:
      return read_lammps_data(bytes, name, frame);
    case Format::poscar:
      return read_poscar(bytes, name, frame);
    case Format::xdatcar:
      return read_xdatcar(bytes, name, frame);
    case Format::sdf:
      return read_sdf(bytes, name, frame);
    case Format::mol2:
      return read_mol2(bytes, name, frame);
    case Format::small_cif:
      return read_small_cif(bytes, name, frame);
    case Format::ply:
      return read_ply(bytes, name, frame);
    case Format::pcd:
      return read_pcd(bytes, name, frame);
    case Format::vtk_legacy:
      return read_vtk_legacy(bytes, name, frame);
    case Format::vtk_xml:
      return read_vtk_xml(bytes, name, frame);
    case Format::gsd:
      return read_gsd(bytes, name, frame);
    case Format::csv:
      return read_csv(bytes, name, frame);
    case Format::npy:
      return read_npy(bytes, name, frame);
    case Format::npz:
      return read_npz(bytes, name, frame);
  }
  return Error{"unknown format", name, 0, 0, ""};
}

// Whether the last line of every whole file has an end.
bool ends_in_a_line(Format format) {
  switch (format) {
    case Format::npy:
    case Format::npz:
    case Format::gsd:
    case Format::ply:
    case Format::pcd:
    case Format::vtk_legacy:
    case Format::vtk_xml:
      return false;
    default:
      return true;
  }
}

// The content tells, then the name. A format that is known and not read, or not without another file, is named.
Result<Format> find_format(std::string_view bytes, const std::string& name) {
  if (const auto format = format_by_content(bytes, name)) return *format;
  std::optional<ForeignFormat> foreign = foreign_by_content(bytes);
  if (!foreign) {
    if (const auto format = format_by_name(name)) return *format;
    foreign = foreign_by_name(name);
  }
  if (foreign) {
    const char* const why = foreign->needs_atoms ? ", which is read only together with a file of its atoms"
                                                 : ", which bihive does not read";
    return Error{"this is " + foreign->name + why, name, 0, 0, foreign->advice};
  }
  return Error{"this is no file of spheres in a known format", name, 0, 0, "known are " + known_formats()};
}

// The places, the cell and the time of the trajectory's frame in place of the file's.
Status take_frame_of(const std::string& path, std::int64_t frame, RawSpheres& raw) {
  const Result<std::shared_ptr<const Trajectory>> trajectory = open_trajectory(path);
  if (!trajectory) return trajectory.error();
  const std::int64_t count = (*trajectory)->sphere_count();
  if (count != static_cast<std::int64_t>(raw.size()))
    return Error{"the trajectory has " + std::to_string(count) + " atoms, and the file of the atoms has " +
                     std::to_string(raw.size()),
                 path, 0, 0, "both must be of the same simulation, with the same atoms left out"};
  Result<TrajectoryFrame> read = (*trajectory)->read(frame);
  if (!read) return read.error();
  raw.x = std::move(read->x);
  raw.y = std::move(read->y);
  raw.z = std::move(read->z);
  if (read->cell) raw.cell = read->cell;
  raw.time_ps = read->time_ps;
  raw.step = read->step;
  raw.frames = (*trajectory)->frame_count();
  raw.rules.push_back("places: frame " + std::to_string(frame) + " (from 0) of " + printable(path) + ", " +
                      (*trajectory)->format());
  raw.warnings.insert(raw.warnings.end(), (*trajectory)->warnings().begin(), (*trajectory)->warnings().end());
  return Done{};
}

Result<SphereFile> read_unpacked(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  if (bytes.empty()) return Error{"the file is empty", name, 0, 0, ""};
  const Result<Format> format = find_format(bytes, name);
  if (!format) return format.error();
  const bool is_moved = !options.trajectory.empty();
  Result<RawSpheres> raw = read_format(*format, bytes, name, is_moved ? 0 : options.frame);
  if (!raw) return raw.error();
  // A radius that is a guess is the file's own, so that it is the same in each frame.
  if (is_moved && !options.radius && lacks_radii(*raw)) raw->unknown_radius = radius_from_neighbours(*raw);
  if (is_moved)
    if (Status status = take_frame_of(options.trajectory, options.frame, *raw); !status) return status.error();
  if (ends_in_a_line(*format) && bytes.back() != '\n')
    raw->warnings.push_back("the last line of " + name + " has no end: the file may be cut");
  if (!options.assembly.empty())
    if (Status status = expand_assembly(*raw, options.assembly, name); !status) return status.error();
  std::vector<NamedTexts>& texts = raw->attributes.texts;
  texts.erase(std::remove_if(texts.begin(), texts.end(),
                             [](const NamedTexts& column) { return column.name == kAssemblyChains; }),
              texts.end());

  // The spheres of a film keep their size: a radius that is a guess is the first frame's. If that frame cannot tell,
  // each frame has its own.
  if (!is_moved && options.frame != 0 && !options.radius && lacks_radii(*raw))
    if (const Result<RawSpheres> first = read_format(*format, bytes, name, 0); first && lacks_radii(*first))
      raw->unknown_radius = radius_from_neighbours(*first);
  return finish_spheres(std::move(*raw), name, options);
}

}  // namespace

Result<SphereFile> read_spheres_from_memory(std::string_view bytes, const std::string& name,
                                            const ReadOptions& options) {
  // The readers return every error but one: lack of memory throws.
  try {
    if (!looks_gzipped(bytes)) return read_unpacked(bytes, name, options);
    Result<std::string> unpacked = gunzip(bytes, name);
    if (!unpacked) return unpacked.error();
    return read_unpacked(*unpacked, name, options);
  } catch (const std::bad_alloc&) {
    return Error{"there is not enough memory to read it", name, 0, 0, ""};
  } catch (const std::exception& e) {
    return Error{"reading failed: " + std::string(e.what()), name, 0, 0, ""};
  }
}

Result<std::string> unpack_gzip(std::string bytes, const std::string& name) {
  if (!looks_gzipped(bytes)) return bytes;
  return gunzip(bytes, name);
}

Result<SphereFile> read_spheres(const std::string& path, const ReadOptions& options) {
  Result<std::string> bytes = read_file(path);
  if (!bytes) return bytes.error();
  return read_spheres_from_memory(*bytes, path, options);
}

}  // namespace bihive
