// The checks of every fuzz target of a reader: an answer that agrees with itself, or an error in one line.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bihive/io/read_spheres.h"
#include "bihive/io/readers.h"
#include "bihive/io/text_scanner.h"
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

/// One reader's answer. The first byte of the input chooses the frame.
template <class Reader>
void read_raw(Reader reader, const std::uint8_t* data, std::size_t size) {
  if (size == 0) return;
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  const Result<RawSpheres> raw = reader(text, "fuzz", data[0] % 4);
  if (!raw) return check_error(raw.error());
  require(raw->frames > data[0] % 4 && !raw->format.empty());
  require(raw->y.size() == raw->size() && raw->z.size() == raw->size());
  require(raw->r.empty() || raw->r.size() == raw->size());
  for (const auto* axis : {&raw->x, &raw->y, &raw->z})
    for (const double value : *axis) require(std::isfinite(value));
  for (const double r : raw->r) require(r >= 0 && std::isfinite(r));
  check_attributes(raw->attributes, raw->size());

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

/// Every number is read again with the same bits.
inline void check_written(const SphereSet& spheres) {
  constexpr std::int64_t kMost = 500;
  if (spheres.size() > kMost) return;
  const auto same = [](double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; };
  for (const auto& [format, name] :
       {std::pair{SphereFileFormat::csv, "a.csv"}, std::pair{SphereFileFormat::extended_xyz, "a.extxyz"}}) {
    const Result<SphereFile> again = read_spheres_from_memory(write_spheres(spheres, format).bytes, name, {});
    require(again.ok() && again->spheres.size() == spheres.size());
    for (std::int64_t id = 0; id < spheres.size(); ++id) {
      const Vec3d a = spheres.centre(id), b = again->spheres.centre(id);
      require(same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z));
      require(same(spheres.radius(id), again->spheres.radius(id)));
    }
    if (format == SphereFileFormat::npy) continue;
    const auto element_of = [](const SphereSet& set, std::size_t i) {
      return set.attributes().element.empty() ? 0 : set.attributes().element[i];
    };
    for (std::size_t i = 0; i < static_cast<std::size_t>(spheres.size()); ++i)
      require(element_of(spheres, i) == element_of(again->spheres, i));
    require(again->spheres.attributes().opacity == spheres.attributes().opacity);
  }
}

/// The whole way from bytes to a sphere set. The first byte chooses the options.
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
  const Result<SphereFile> file = read_spheres_from_memory(bytes, names[data[0] / 8 % 9], options);
  if (!file) return check_error(file.error());
  require(file->spheres.size() > 0 && file->frames > options.frame);
  for (std::int64_t id = 0; id < file->spheres.size(); ++id)
    require(is_finite(file->spheres.centre(id)) && file->spheres.radius(id) >= 0);
  check_attributes(file->spheres.attributes(), static_cast<std::size_t>(file->spheres.size()));
  check_written(file->spheres);
}

}  // namespace bihive::fuzz
