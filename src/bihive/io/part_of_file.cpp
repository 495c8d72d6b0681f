#include "bihive/io/part_of_file.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "bihive/base/memory.h"
#include "bihive/io/formats/arrays/array_frames.h"
#include "bihive/io/formats/arrays/gsd.h"
#include "bihive/io/formats/points/npy_layout.h"
#include "bihive/io/packed/binary_number.h"
#include "bihive/io/packed/random_file.h"
#include "bihive/io/part_of_dump.h"
#include "bihive/io/raw_spheres.h"
#include "bihive/io/without_throwing.h"

namespace bihive {
namespace {

// A header is much shorter.
constexpr std::int64_t kHeadBytes = 1 << 16;
// Read at a time.
constexpr std::int64_t kRowsAtOnce = 1 << 18;

Result<NpyLayout> layout_of(const RandomFile& file) {
  const Result<std::string> head = file.read(0, std::min(kHeadBytes, file.size()));
  if (!head) return head.error();
  return npy_layout(*head, static_cast<std::uint64_t>(file.size()), file.path());
}

bool has_rows_of_spheres(const NpyLayout& layout) {
  return layout.shape.size() == 2 && (layout.shape[1] == 3 || layout.shape[1] == 4) && !layout.fortran_order;
}

// A number by some of the file's bytes, from its beginning to its end. Another program may find another number.
Result<std::uint64_t> fingerprint(const RandomFile& file) {
  constexpr std::int64_t kSamples = 16, kSampleBytes = 4096;
  std::string samples;
  const std::int64_t bytes = std::min(kSampleBytes, file.size());
  for (std::int64_t k = 0; k < kSamples; ++k) {
    const Result<std::string> sample = file.read((file.size() - bytes) / (kSamples - 1) * k, bytes);
    if (!sample) return sample.error();
    samples += *sample;
  }
  return std::uint64_t{std::hash<std::string>()(samples)};
}

// Parts of different files would make a set that nobody has. `facts`: besides size and fingerprint.
Status see_alike(const RandomFile& file, const SetParts& parts, std::vector<double> facts) {
  const Result<std::uint64_t> number = fingerprint(file);
  if (!number) return number.error();
  facts.insert(facts.end(), {double(file.size()), double(*number >> 32), double(*number & 0xFFFFFFFF)});
  std::vector<double> greatest = facts;
  for (const double fact : facts) greatest.push_back(-fact);
  parts.take_greatest(greatest);
  for (std::size_t i = 0; i < facts.size(); ++i)
    if (greatest[i] != -greatest[facts.size() + i])
      return Error{"the ranks see different files of this name", file.path(), 0, 0,
                   "let all ranks see the same folder"};
  return Done{};
}

Result<RawSpheres> rows_of(const RandomFile& file, const NpyLayout& layout, std::int64_t first, std::int64_t end) {
  const auto columns = static_cast<std::size_t>(layout.shape[1]);
  const std::size_t row_bytes = columns * layout.type.size;
  const double wanted = static_cast<double>(end - first) * static_cast<double>(columns * sizeof(double));
  if (Status status = check_memory(wanted, "a part of the NPY array"); !status)
    return Error{status.error().message, file.path(), 0, 0, ""};
  RawSpheres spheres;
  spheres.format = "NPY";
  std::vector<double>* const targets[4] = {&spheres.x, &spheres.y, &spheres.z, &spheres.r};
  const char* const names[4] = {"x", "y", "z", "the radius"};
  for (std::size_t column = 0; column < columns; ++column)
    targets[column]->resize(static_cast<std::size_t>(end - first));
  std::string bytes;
  for (std::int64_t row = first; row < end; row += kRowsAtOnce) {
    const std::int64_t count = std::min(kRowsAtOnce, end - row);
    bytes.resize(static_cast<std::size_t>(count) * row_bytes);
    const std::int64_t place =
        static_cast<std::int64_t>(layout.data_begin) + row * static_cast<std::int64_t>(row_bytes);
    if (Status status = file.read_into(place, static_cast<std::int64_t>(bytes.size()), bytes.data()); !status)
      return status.error();
    for (std::int64_t i = 0; i < count; ++i)
      for (std::size_t column = 0; column < columns; ++column) {
        const double value =
            number_at(bytes.data() + static_cast<std::size_t>(i) * row_bytes + column * layout.type.size, layout.type);
        if (const char* fault = column < 3 ? coordinate_fault(value) : radius_fault(value))
          return Error{"row " + std::to_string(row + i) + " (from 0): " + names[column] + " " + fault + ": " +
                           std::to_string(value),
                       file.path(), 0, 0, ""};
        (*targets[column])[static_cast<std::size_t>(row - first + i)] = value;
      }
  }
  spheres.rules.push_back("NPY " + layout.dtype + ": columns x, y, z" +
                          (columns == 4 ? std::string(", radius") : std::string()));
  return spheres;
}

Result<RawSpheres> part_of_npy(const RandomFile& file, const SetParts& parts) {
  const Result<NpyLayout> layout = layout_of(file);
  if (!layout) return layout.error();
  if (!has_rows_of_spheres(*layout)) return Error{"parts of this file cannot be read", file.path(), 0, 0, ""};
  const std::int64_t rows = layout->shape[0];
  const Status alike = see_alike(file, parts, {double(rows), double(layout->shape[1]), double(layout->type.size)});
  if (!alike) return alike.error();
  const RowRange own = rows_of_part(&parts, rows);
  return rows_of(file, *layout, own.first, own.end);
}

// Fewer are not worth it, and with many ranks some would have none.
constexpr std::int64_t kFewestParticles = 1 << 16;

bool has_many_particles(const GsdFile& file) {
  return file.schema() == "hoomd" && file.rows(0, "particles/position").value_or(0) >= kFewestParticles;
}

// The rows of a part may decide whether a column is a text, numbers, or nothing.
Status have_equal_columns(const RawSpheres& spheres, const std::string& path, const SetParts& parts) {
  const SphereAttributes& attributes = spheres.attributes;
  std::string columns = spheres.r.empty() ? "" : "r ";
  if (!attributes.type.empty()) columns += "type ";
  if (!attributes.opacity.empty()) columns += "opacity ";
  for (const NamedNumbers& column : attributes.numbers) columns += "/" + column.name;
  const double number = static_cast<double>(std::hash<std::string>()(columns) >> 12);
  std::vector<double> greatest{number, -number, attributes.texts.empty() ? 0.0 : 1.0};
  parts.take_greatest(greatest);
  if (greatest[0] == -greatest[1] && greatest[2] == 0) return Done{};
  return Error{"parts of this file can be read only if all columns are numbers, and types whole ones", path, 0, 0,
               "leave out --distribute, or convert the file: bihive convert FILE -o set.npy"};
}

enum class Kind { none, npy, gsd, dump, arrays };

Kind kind_of(const RandomFile& file) {
  const Result<std::string> head = file.read(0, std::min<std::int64_t>(8, file.size()));
  if (head && GsdFile::looks_like(*head)) return Kind::gsd;
  if (layout_of(file)) return Kind::npy;
  if (atoms_in_parts(file).value_or(0) >= kFewestParticles) return Kind::dump;
  Result<RandomFile> again = RandomFile::open(file.path());
  if (again && particles_in_parts(std::move(*again)).value_or(0) >= kFewestParticles) return Kind::arrays;
  return Kind::none;
}

}  // namespace

bool can_read_part(const std::string& path) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) return false;
  Result<RandomFile> file = RandomFile::open(path);
  if (!file) return false;
  switch (kind_of(*file)) {
    case Kind::gsd: {
      const Result<GsdFile> opened = GsdFile::open(std::move(*file));
      return opened && has_many_particles(*opened);
    }
    case Kind::npy:
      return has_rows_of_spheres(*layout_of(*file));
    case Kind::dump:
    case Kind::arrays:
      return true;
    case Kind::none:
      break;
  }
  return false;
}

Result<RawSpheres> read_part(const std::string& path, const SetParts& parts) {
  return without_throwing(path, [&]() -> Result<RawSpheres> {
    Result<RandomFile> file = RandomFile::open(path);
    if (!file) return file.error();
    const Kind kind = kind_of(*file);
    if (const Status alike = see_alike(*file, parts, {double(static_cast<int>(kind))}); !alike) return alike.error();
    switch (kind) {
      case Kind::gsd: {
        const Result<GsdFile> opened = GsdFile::open(std::move(*file));
        if (!opened) return opened.error();
        return read_gsd_frame(*opened, 0, &parts);
      }
      case Kind::dump:
      case Kind::arrays: {
        Result<RawSpheres> part =
            kind == Kind::dump ? part_of_dump(*file, parts) : part_of_arrays(std::move(*file), parts);
        if (!part) return part;
        if (const Status equal = have_equal_columns(*part, path, parts); !equal) return equal.error();
        return part;
      }
      case Kind::npy:
      case Kind::none:
        break;
    }
    return part_of_npy(*file, parts);
  });
}

}  // namespace bihive
