#include "bihive/io/raw_spheres.h"

#include <cmath>
#include <limits>
#include <utility>

#include "bihive/base/setting_name.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {

void add_bond(RawSpheres& spheres, std::optional<std::int64_t> one, std::optional<std::int64_t> other,
              BondOrder order) {
  const auto count = static_cast<std::int64_t>(spheres.size());
  if (!one || !other || *one < 1 || *other < 1 || *one > count || *other > count) return;
  spheres.attributes.bonds.add(static_cast<std::int32_t>(*one - 1), static_cast<std::int32_t>(*other - 1), order);
}

Error no_such_frame(const std::string& file, std::int64_t frame, std::int64_t frames) {
  const std::string what = "there is no frame " + std::to_string(frame) + ": the file has ";
  if (frames == 0) return {what + "none", file, 0, 0, ""};
  const std::string have =
      frames == 1 ? "one only (0)" : std::to_string(frames) + " (0 to " + std::to_string(frames - 1) + ")";
  return {what + have, file, 0, 0, "choose one with " + setting_name("frame") + ", counting from 0"};
}

std::string spheres_have(std::int64_t count) {
  return std::to_string(count) + (count == 1 ? " sphere has" : " spheres have");
}

NamedTexts printable_texts(NamedTexts column) {
  bool all_printable = true;
  for (const std::string& text : column.texts) all_printable = all_printable && printable(text) == text;
  if (all_printable) return column;

  // Collect them again: two texts may have become one.
  TextCollector collector;
  collector.reserve(column.text_of_sphere.size());
  for (std::size_t i = 0; i < column.text_of_sphere.size(); ++i) collector.add(printable(column.of(i)));
  return collector.take(std::move(column.name));
}

const char* coordinate_fault(double value) {
  if (!std::isfinite(value)) return "is not finite";
  if (!(std::abs(value) <= double(std::numeric_limits<float>::max()))) return "is beyond single precision (3.4e38)";
  return nullptr;
}

const char* radius_fault(double value) {
  if (const char* fault = coordinate_fault(value)) return fault;
  return value < 0 ? "is negative" : nullptr;
}

}  // namespace bihive
