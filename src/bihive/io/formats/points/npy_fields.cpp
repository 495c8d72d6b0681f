#include "bihive/io/formats/points/npy_fields.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "bihive/base/memory.h"
#include "bihive/base/parse_number.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

// No file is larger.
constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 48;

// The product, or nothing if it is larger than any file.
std::optional<std::uint64_t> product(std::uint64_t start, const std::vector<std::int64_t>& shape) {
  for (const std::int64_t extent : shape) {
    const auto factor = static_cast<std::uint64_t>(extent);
    if (factor != 0 && start > kMostBytes / factor) return std::nullopt;
    start *= factor;
  }
  return start;
}

// The bytes of one number or text: "<f4", "|S5", "<U3" (four bytes a letter), "<M8[ns]"; nothing for objects.
std::optional<std::uint64_t> bytes_of_type(std::string_view dtype) {
  if (dtype.size() < 3) return std::nullopt;
  const char kind = dtype[1];
  const std::string_view digits = dtype.substr(2, dtype.find('[') - 2);
  const auto count = parse_int(digits);
  if (!count || *count < 0 || *count > (1 << 30) || kind == 'O') return std::nullopt;
  return static_cast<std::uint64_t>(*count) * (kind == 'U' ? 4 : 1);
}

}  // namespace

Result<std::vector<NamedArray>> npy_fields(std::string_view bytes, const NpyHeader& header, const std::string& file,
                                           std::string& left_out) {
  const auto bad = [&file](const std::string& what) { return Error{what, file, 0, 0, ""}; };

  // Find where each field stands in a row.
  struct Place {
    const NpyField* field;
    std::uint64_t begin, count;
    NumberType type;
  };
  std::vector<Place> numbers;
  std::uint64_t row_bytes = 0, numbers_of_row = 0;
  for (const NpyField& field : header.fields) {
    const std::optional<std::uint64_t> size = bytes_of_type(field.dtype), count = product(1, field.shape);
    const std::optional<std::uint64_t> all = size && count ? product(*size, field.shape) : std::nullopt;
    if (!all || row_bytes + *all > kMostBytes)
      return bad("the field " + quote(field.name) + " of the NPY array has the type " + quote(field.dtype) +
                 ", whose length is unknown");
    std::optional<NumberType> type = npy_number_type(field.dtype);
    if (field.dtype == "|b1") type = NumberType{'u', 1, false};
    if (type) {
      numbers.push_back({&field, row_bytes, *count, *type});
      numbers_of_row += *count;
    } else if (!field.name.empty()) {
      left_out += " " + field.name;
    }
    row_bytes += *all;
  }

  // The shape must agree with the size of the file.
  const std::uint64_t data_bytes = bytes.size() - header.data_begin;
  const std::optional<std::uint64_t> rows = product(1, header.shape);
  const bool fits = rows && row_bytes > 0 && *rows == data_bytes / row_bytes && data_bytes % row_bytes == 0;
  if (!fits)
    return bad("the NPY array's shape " + npy_shape_text(header.shape) + " of rows of " + std::to_string(row_bytes) +
               " bytes does not agree with the " + std::to_string(data_bytes) + " bytes of numbers in the file");
  if (Status status = check_memory(static_cast<double>(*rows) * static_cast<double>(numbers_of_row) * sizeof(double),
                                   "the fields of the NPY array");
      !status)
    return bad(status.error().message);

  std::vector<NamedArray> arrays;
  for (const Place& place : numbers) {
    NamedArray array{place.field->name, {static_cast<std::int64_t>(*rows)}, {}};
    if (!place.field->shape.empty()) array.shape.push_back(static_cast<std::int64_t>(place.count));
    array.values.reserve(static_cast<std::size_t>(*rows * place.count));
    for (std::uint64_t row = 0; row < *rows; ++row) {
      const char* at = bytes.data() + header.data_begin + row * row_bytes + place.begin;
      for (std::uint64_t i = 0; i < place.count; ++i, at += place.type.size)
        array.values.push_back(number_at(at, place.type));
    }
    arrays.push_back(std::move(array));
  }
  return arrays;
}

}  // namespace bihive
