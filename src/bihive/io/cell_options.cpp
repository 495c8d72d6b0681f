#include "bihive/io/cell_options.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "bihive/base/parse_number.h"

namespace bihive {
namespace {

Result<std::vector<double>> finite_numbers(const std::string& text, std::size_t count, const std::string& form) {
  std::vector<double> numbers = numbers_from_text(text);
  if (numbers.size() == count && std::all_of(numbers.begin(), numbers.end(), [](double n) { return std::isfinite(n); }))
    return numbers;
  return unexpected(std::to_string(count) + " finite numbers as " + form, text);
}

}  // namespace

Result<std::array<std::int32_t, 3>> copies_from_text(const std::string& text) {
  const auto bad = [&] {
    return unexpected("three whole numbers from 1 to " + std::to_string(kMostCopies) + " as 3x3x1", text);
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
