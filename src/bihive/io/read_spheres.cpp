#include "bihive/io/read_spheres.h"

#include <algorithm>
#include <exception>

#include "bihive/base/write_file.h"
#include "bihive/io/detect.h"
#include "bihive/io/finish.h"
#include "bihive/io/gunzip.h"
#include "bihive/io/readers.h"
#include "bihive/io/unknown_radii.h"

namespace bihive {
namespace {

Result<RawSpheres> read_format(Format format, std::string_view bytes, const std::string& name, std::int64_t frame) {
  switch (format) {
    case Format::pdb:
      return read_pdb(bytes, name, frame);
    case Format::mmcif:
      return read_mmcif(bytes, name, frame);
    case Format::xyz:
      return read_xyz(bytes, name, frame);
    case Format::lammps_dump:
      return read_lammps_dump(bytes, name, frame);
    case Format::csv:
      return read_csv(bytes, name, frame);
    case Format::npy:
      return read_npy(bytes, name, frame);
  }
  return Error{"unknown format", name, 0, 0, ""};
}

Result<SphereFile> read_unpacked(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  if (bytes.empty()) return Error{"the file is empty", name, 0, 0, ""};
  const auto format = detect_format(bytes, name);
  if (!format) return Error{"this is no file of spheres in a known format", name, 0, 0, "known are " + known_formats()};
  Result<RawSpheres> raw = read_format(*format, bytes, name, options.frame);
  if (!raw) return raw.error();
  if (!options.assembly.empty())
    if (Status status = expand_assembly(*raw, options.assembly, name); !status) return status.error();
  std::vector<NamedTexts>& texts = raw->attributes.texts;
  texts.erase(std::remove_if(texts.begin(), texts.end(),
                             [](const NamedTexts& column) { return column.name == kAssemblyChains; }),
              texts.end());

  // The spheres of a film keep their size: a radius that is a guess is the first frame's. If that frame cannot tell,
  // each frame has its own.
  if (options.frame != 0 && !options.radius && lacks_radii(*raw))
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
  } catch (const std::exception& e) {
    return Error{"reading failed: " + std::string(e.what()), name, 0, 0, ""};
  }
}

Result<SphereFile> read_spheres(const std::string& path, const ReadOptions& options) {
  Result<std::string> bytes = read_file(path);
  if (!bytes) return bytes.error();
  return read_spheres_from_memory(*bytes, path, options);
}

}  // namespace bihive
