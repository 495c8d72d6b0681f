// The checks of every fuzz target of a reader: an answer that agrees with itself, or an error in one line.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "bihive/io/formats/formats.h"
#include "bihive/io/read_spheres.h"
#include "bihive/io/text/text_scanner.h"
#include "bihive/io/write_spheres.h"

namespace bihive::fuzz {

inline void require(bool condition) {
  if (!condition) std::abort();
}

inline void check_error(const Error& error) {
  require(!error.message.empty());
  require(error.line >= 0 && error.column >= 0);
  require(printable(error.message) == error.message);
}

inline void check_attributes(const SphereAttributes& attributes, std::size_t size) {
  const auto fits = [size](const auto& values) { return values.empty() || values.size() == size; };
  require(fits(attributes.element) && fits(attributes.type) && fits(attributes.colour) && fits(attributes.opacity));
  for (const NamedNumbers& column : attributes.numbers)
    require(column.values.size() == size && printable(column.name) == column.name);
  for (const NamedTexts& column : attributes.texts) {
    require(column.text_of_sphere.size() == size && printable(column.name) == column.name);
    for (const std::string& text : column.texts) require(printable(text) == text);
    for (const std::int32_t text : column.text_of_sphere)
      require(text >= 0 && static_cast<std::size_t>(text) < column.texts.size());
  }
  for (const Vec3f& colour : attributes.colour)
    for (int part = 0; part < 3; ++part) require(colour[part] >= 0 && colour[part] <= 1);
  for (const float opacity : attributes.opacity) require(opacity >= 0 && opacity <= 1);
}

/// One part of --columns and its column, from one byte. A part that comes twice stays as it was.
inline void choose_column(std::uint8_t byte, ColumnChoice& columns) {
  static const char* const parts[] = {
      "x",    "y",   "z",     "r",    "radius",  "diameter",     "element", "atomic_number",
      "type", "red", "green", "blue", "opacity", "transparency", "symbol",  "any"};
  static const char* const names[] = {"1", "2", "3", "4",      "5",   "6", "7", "8",
                                      "9", "x", "Y", "radius", "red", "a", "0", ""};
  // The last name leaves the part out.
  if (byte % 16 != 15) columns.emplace(parts[byte / 16], names[byte % 16]);
}

/// The answer of a reader of that frame.
inline void check_raw(const Result<RawSpheres>& raw, std::int64_t frame) {
  if (!raw) return check_error(raw.error());
  require(raw->frames > frame && !raw->format.empty());
  require(raw->y.size() == raw->size() && raw->z.size() == raw->size());
  require(raw->r.empty() || raw->r.size() == raw->size());
  for (const auto* axis : {&raw->x, &raw->y, &raw->z})
    for (const double value : *axis) require(std::isfinite(value));
  for (const double r : raw->r) require(r >= 0 && std::isfinite(r));
  check_attributes(raw->attributes, raw->size());
}

/// One reader's answer. The first byte of the input chooses the frame.
inline void read_raw(const char* format, const std::uint8_t* data, std::size_t size) {
  if (size == 0) return;
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  const Result<RawSpheres> raw = read_bytes(format_named(format), text, "fuzz", data[0] % 4);
  check_raw(raw, data[0] % 4);
  if (!raw) return;

  // The assemblies that the file states, if they are few.
  const std::vector<std::string> ids = raw->assemblies.ids();
  for (std::size_t i = 0; i < ids.size() && i < 3; ++i) {
    require(printable(ids[i]) == ids[i]);
    RawSpheres copied = *raw;
    if (const Status status = expand_assembly(copied, ids[i], "fuzz"); !status) {
      check_error(status.error());
      continue;
    }
    require(copied.size() > 0 && copied.y.size() == copied.size() && copied.z.size() == copied.size());
    check_attributes(copied.attributes, copied.size());
  }
}

/// Every number is read again with the same bits. `choice`: one of the formats, 0 to 2; writing and reading all of them
/// took more time than what is tested.
inline void check_written(const SphereSet& spheres, std::size_t choice) {
  constexpr std::int64_t kMost = 500;
  if (spheres.size() > kMost) return;
  // NPY has binary32 or binary64, as the set's range needs.
  if (choice == 2) {
    const Result<SphereFile> again =
        read_spheres_from_memory(write_spheres(spheres, SphereFileFormat::npy).bytes, "a.npy", {});
    return require(again.ok() && again->spheres.size() == spheres.size());
  }
  const auto same = [](double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; };
  const SphereFileFormat format = choice == 0 ? SphereFileFormat::csv : SphereFileFormat::extended_xyz;
  const Result<SphereFile> again =
      read_spheres_from_memory(write_spheres(spheres, format).bytes, choice == 0 ? "a.csv" : "a.extxyz", {});
  require(again.ok() && again->spheres.size() == spheres.size());
  for (std::int64_t id = 0; id < spheres.size(); ++id) {
    const Vec3d a = spheres.centre(id), b = again->spheres.centre(id);
    // Numbers that were rounded about an origin may need none when they are read again. Then rounding about 0 moves
    // every centre by a harmless share of its radius at most, which is why there is none.
    const bool is_harmless = spheres.has_origin() && !again->spheres.has_origin() &&
                             length(a - b) <= 2 * SphereSet::kHarmlessShift * spheres.radius(id);
    require((same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z)) || is_harmless);
    require(same(spheres.radius(id), again->spheres.radius(id)));
  }
  const auto element_of = [](const SphereSet& set, std::size_t i) {
    return set.attributes().element.empty() ? 0 : set.attributes().element[i];
  };
  for (std::size_t i = 0; i < static_cast<std::size_t>(spheres.size()); ++i)
    require(element_of(spheres, i) == element_of(again->spheres, i));
  require(again->spheres.attributes().opacity == spheres.attributes().opacity);
}

/// A file without a name that holds these bytes. It stays open as long as this lives.
class FileInMemory {
 public:
  explicit FileInMemory(std::string_view bytes) : file_(memfd_create("fuzz", MFD_CLOEXEC)) {
    require(file_ >= 0 && write(file_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()));
  }
  ~FileInMemory() { close(file_); }
  FileInMemory(const FileInMemory&) = delete;
  FileInMemory& operator=(const FileInMemory&) = delete;

  std::string path() const { return "/proc/self/fd/" + std::to_string(file_); }

 private:
  int file_;
};

/// Two frames of one atom, as XTC holds so few: not packed.
inline std::string small_trajectory() {
  std::string bytes;
  const auto put = [&](std::uint32_t word) {
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(word >> shift & 0xff);
  };
  for (const std::uint32_t frame : {0U, 1U}) {
    for (const std::uint32_t word : {1995U, 1U, frame, 0U}) put(word);
    for (int i = 0; i < 9; ++i) put(i % 4 == 0 ? 0x40000000U : 0U);  // a cell of 2 x 2 x 2 nm
    put(1);
    for (const std::uint32_t word : {0x3F800000U, 0x3F000000U, 0x40400000U}) put(word);
  }
  return bytes;
}

/// The options of periodic cells, and of files on the disk.
inline void choose_more(int choice, ReadOptions& options) {
  static const FileInMemory trajectory(small_trajectory());
  if (choice == 0) options.wrapping = Wrapping::wrap;
  if (choice == 0 || choice == 2) options.replicate = {2, 1, 3};
  if (choice == 1) options.wrapping = Wrapping::unwrap;
  if (choice == 1 || choice == 2) options.smooth = 3;
  if (choice == 2) options.wrapping = Wrapping::wrap_molecules;
  if (choice == 2) options.cell_vectors = {Vec3d{2, 0, 0}, Vec3d{0.5, 3, 0}, Vec3d{0, 0, 1e3}};
  if (choice <= 2) options.cell_origin = Vec3d{0.25, -1, 0};
  if (choice == 3) options.trajectory = trajectory.path();
}

/// The whole way from bytes to a sphere set. The first byte chooses the options; from kMore on those of cells and
/// files.
inline void read_whole(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return;
  ReadOptions options;
  options.frame = data[0] & 1;
  options.recenter = data[0] & 2;
  const int choice = data[0] & 7;
  if (choice & 4) options.radius = 0.25;
  if (choice == 5) options.assembly = "1";
  if (choice == 6) options.radius_scale = -2;
  if (choice == 7) options.radius = -1;
  const char* const names[] = {"fuzz",     "fuzz.pdb.gz", "fuzz.cif", "fuzz.xyz", "fuzz.dump",
                               "fuzz.csv", "fuzz.npy",    "fuzz.pqr", "fuzz.gro"};
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  constexpr int kMore = 216;
  const int more = data[0] >= kMore ? (data[0] - kMore) / 8 : -1;
  if (more >= 0) choose_more(more, options);
  // Columns by the input's length.
  if (more == 4)
    for (const std::size_t part : {size, size / 3, size * 7})
      choose_column(static_cast<std::uint8_t>(part), options.columns);
  const Result<SphereFile> file = more >= 3 ? read_spheres(FileInMemory(bytes).path(), options)
                                            : read_spheres_from_memory(bytes, names[data[0] / 8 % 9], options);
  if (!file) return check_error(file.error());
  require(file->spheres.size() > 0 && file->frames > options.frame);
  for (std::int64_t id = 0; id < file->spheres.size(); ++id)
    require(is_finite(file->spheres.centre(id)) && file->spheres.radius(id) >= 0);
  check_attributes(file->spheres.attributes(), static_cast<std::size_t>(file->spheres.size()));
  // Copies along a cell would be written as spheres of their own, whose rounding is another.
  if (file->spheres.total_size() == file->spheres.size()) check_written(file->spheres, size % 3);
}

}  // namespace bihive::fuzz
