#include "bihive/io/text/fields.h"

#include "bihive/base/parse_number.h"
#include "bihive/io/raw_spheres.h"

namespace bihive {

Result<double> take_number(TextScanner& scanner, const std::string& what) {
  std::string_view field;
  scanner.next_field(field);
  const auto value = parse_double(field);
  if (!value) return scanner.field_error("expected a number for " + what + " but found " + quote(field));
  if (const char* fault = coordinate_fault(*value))
    return scanner.field_error(what + " " + fault + ": " + quote(field));
  return *value;
}

Result<Vec3d> take_place(TextScanner& scanner) {
  Vec3d place;
  for (int axis = 0; axis < 3; ++axis) {
    const Result<double> value = take_number(scanner, std::string(1, "xyz"[axis]));
    if (!value) return value.error();
    place[axis] = *value;
  }
  return place;
}

Result<std::int64_t> take_count(TextScanner& scanner, const std::string& what) {
  std::string_view field;
  scanner.next_field(field);
  const auto count = parse_int(field);
  if (!count || *count < 0) return scanner.field_error("expected " + what + " but found " + quote(field));
  return *count;
}

}  // namespace bihive
