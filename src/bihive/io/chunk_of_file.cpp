#include "bihive/io/chunk_of_file.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bihive/base/memory.h"
#include "bihive/io/chunk_of_dump.h"
#include "bihive/io/formats/arrays/array_frames.h"
#include "bihive/io/formats/arrays/gsd.h"
#include "bihive/io/formats/points/npy_layout.h"
#include "bihive/io/packed/binary_number.h"
#include "bihive/io/packed/random_file.h"
#include "bihive/io/raw_spheres.h"
#include "bihive/io/text/text_scanner.h"
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

Result<RawSpheres> rows_of(const RandomFile& file, const NpyLayout& layout, std::int64_t first, std::int64_t end) {
  const auto columns = static_cast<std::size_t>(layout.shape[1]);
  const std::size_t row_bytes = columns * layout.type.size;
  const double wanted = static_cast<double>(end - first) * static_cast<double>(columns * sizeof(double));
  if (Status status = check_memory(wanted, "a chunk of the NPY array"); !status)
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

Status open_npy(const std::shared_ptr<const RandomFile>& file, RowChunk chunk, FileChunk& opened) {
  const Result<NpyLayout> layout = layout_of(*file);
  if (!layout) return layout.error();
  if (!has_rows_of_spheres(*layout)) return Error{"parts of this file cannot be read", file->path(), 0, 0, ""};
  const std::int64_t rows = layout->shape[0];
  opened.facts.insert(opened.facts.end(), {double(rows), double(layout->shape[1]), double(layout->type.size)});
  const RowRange own = chunk.of(rows);
  opened.rows = own.count();
  opened.read = [file, layout = *layout, own](std::int64_t, std::int64_t) {
    return rows_of(*file, layout, own.first, own.end);
  };
  return Done{};
}

Status open_dump(const RandomFile& file, RowChunk chunk, FileChunk& opened) {
  Result<DumpChunk> lines = DumpChunk::read(file, chunk);
  if (!lines) return lines.error();
  const auto dump = std::make_shared<DumpChunk>(std::move(*lines));
  opened.rows = dump->rows();
  opened.columns_may_differ = true;
  opened.read = [dump](std::int64_t first, std::int64_t all) { return dump->spheres(first, all); };
  return Done{};
}

// Fewer are not worth it, and with many ranks some would have none.
constexpr std::int64_t kFewestParticles = 1 << 16;

bool has_many_particles(const GsdFile& file) {
  return file.schema() == "hoomd" && file.rows(0, "particles/position").value_or(0) >= kFewestParticles;
}

enum class Kind { none, npy, gsd, dump, arrays };

Kind kind_of(const RandomFile& file) {
  const Result<std::string> head = file.read(0, std::min<std::int64_t>(8, file.size()));
  if (head && GsdFile::looks_like(*head)) return Kind::gsd;
  if (layout_of(file)) return Kind::npy;
  if (atoms_in_chunks(file).value_or(0) >= kFewestParticles) return Kind::dump;
  Result<RandomFile> again = RandomFile::open(file.path());
  if (again && particles_in_chunks(std::move(*again)).value_or(0) >= kFewestParticles) return Kind::arrays;
  return Kind::none;
}

}  // namespace

bool can_read_chunks(const std::string& path) {
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

Result<FileChunk> open_chunk(const std::string& path, RowChunk chunk) {
  return without_throwing(path, [&]() -> Result<FileChunk> {
    Result<RandomFile> opened = RandomFile::open(path);
    if (!opened) return opened.error();
    const auto file = std::make_shared<RandomFile>(std::move(*opened));
    const Kind kind = kind_of(*file);
    const Result<std::uint64_t> samples = fingerprint(*file);
    if (!samples) return samples.error();
    FileChunk made;
    made.facts = {double(static_cast<int>(kind)), double(file->size()), double(*samples >> 32),
                  double(*samples & 0xFFFFFFFF)};
    Status status = Done{};
    switch (kind) {
      case Kind::gsd:
        made.read = [file, chunk](std::int64_t, std::int64_t) -> Result<RawSpheres> {
          const Result<GsdFile> gsd = GsdFile::open(std::move(*file));
          if (!gsd) return gsd.error();
          return read_gsd_frame(*gsd, 0, chunk);
        };
        break;
      case Kind::arrays:
        made.columns_may_differ = true;
        made.read = [file, chunk](std::int64_t, std::int64_t) { return chunk_of_arrays(std::move(*file), chunk); };
        break;
      case Kind::dump:
        status = open_dump(*file, chunk, made);
        break;
      case Kind::npy:
      case Kind::none:
        status = open_npy(file, chunk, made);
        break;
    }
    // Facts that differ say more than this.
    if (!status) made.read = [error = status.error()](std::int64_t, std::int64_t) { return error; };
    made.read = [path, read = std::move(made.read)](std::int64_t first, std::int64_t all) {
      return without_throwing(path, [&] { return read(first, all); });
    };
    return made;
  });
}

std::optional<double> columns_of(const RawSpheres& spheres) {
  const SphereAttributes& attributes = spheres.attributes;
  if (!attributes.texts.empty()) return std::nullopt;
  std::string columns = spheres.r.empty() ? "" : "r ";
  if (!attributes.type.empty()) columns += "type ";
  if (!attributes.opacity.empty()) columns += "opacity ";
  for (const NamedNumbers& column : attributes.numbers) columns += "/" + column.name;
  return static_cast<double>(std::hash<std::string>()(columns) >> 12);
}

std::vector<double> ids_of(const RawSpheres& chunk) {
  std::vector<double> facts{static_cast<double>(chunk.ids)};
  if (chunk.ids == RowIds::in_order)
    for (const NamedNumbers& column : chunk.attributes.numbers)
      if (lower_case(column.name) == "id") facts.insert(facts.end(), {column.values.front(), column.values.back()});
  return facts;
}

bool ids_increase(const std::vector<std::vector<double>>& of_chunks) {
  double last = -std::numeric_limits<double>::infinity();
  for (const std::vector<double>& facts : of_chunks) {
    if (facts[0] == static_cast<double>(RowIds::none)) continue;
    if (facts.size() < 3 || !(last < facts[1])) return false;
    last = facts[2];
  }
  return true;
}

}  // namespace bihive
