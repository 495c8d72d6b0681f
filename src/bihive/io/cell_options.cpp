#include "bihive/io/cell_options.h"

#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "bihive/base/parse_number.h"

namespace bihive {
namespace {

std::vector<std::string_view> parts_of(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

Result<std::vector<double>> finite_numbers(const std::string& text, std::size_t count, const std::string& form) {
  const auto bad = [&] {
    return Error{"expected " + std::to_string(count) + " finite numbers as " + form + ", found \"" + text + "\"", "", 0,
                 0, ""};
  };
  const std::vector<std::string_view> parts = parts_of(text, ',');
  if (parts.size() != count) return bad();
  std::vector<double> numbers;
  for (const std::string_view part : parts) {
    const std::optional<double> number = parse_double(part);
    if (!number || !std::isfinite(*number)) return bad();
    numbers.push_back(*number);
  }
  return numbers;
}

}  // namespace

Result<std::array<std::int32_t, 3>> copies_from_text(const std::string& text) {
  const auto bad = [&] {
    return Error{
        "expected three whole numbers from 1 to " + std::to_string(kMostCopies) + " as 3x3x1, found \"" + text + "\"",
        "", 0, 0, ""};
  };
  const std::vector<std::string_view> parts = parts_of(text, 'x');
  if (parts.size() != 3) return bad();
  std::array<std::int32_t, 3> copies{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<std::int64_t> number = parse_int(parts[i]);
    if (!number || *number < 1 || *number > kMostCopies) return bad();
    copies[i] = static_cast<std::int32_t>(*number);
  }
  return copies;
}

Result<std::array<Vec3d, 3>> cell_vectors_from_text(const std::string& text) {
  const auto numbers = finite_numbers(text, 9, "AX,AY,AZ,BX,BY,BZ,CX,CY,CZ");
  if (!numbers) return numbers.error();
  const std::vector<double>& n = *numbers;
  return std::array<Vec3d, 3>{Vec3d{n[0], n[1], n[2]}, Vec3d{n[3], n[4], n[5]}, Vec3d{n[6], n[7], n[8]}};
}

Result<Vec3d> cell_origin_from_text(const std::string& text) {
  const auto numbers = finite_numbers(text, 3, "X,Y,Z");
  if (!numbers) return numbers.error();
  return Vec3d{(*numbers)[0], (*numbers)[1], (*numbers)[2]};
}

}  // namespace bihive
