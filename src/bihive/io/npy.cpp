// The format [NumPy-format]: a header (npy_header.h), then the numbers.
#include "bihive/io/npy.h"

#include <limits>
#include <optional>

#include "bihive/base/memory.h"
#include "bihive/base/parse_number.h"
#include "bihive/io/formats/points/npy_layout.h"
#include "bihive/io/packed/binary_number.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

template <class T>
std::string bytes_of(const std::vector<T>& values, const std::vector<std::int64_t>& shape, const char* dtype) {
  std::int64_t count = 1;
  for (const std::int64_t extent : shape) count *= extent;
  BIHIVE_CHECK_EQ(count, static_cast<std::int64_t>(values.size()));

  // Pad the header with blanks so that the numbers begin at a multiple of 64 bytes.
  std::string text =
      "{'descr': '" + std::string(dtype) + "', 'fortran_order': False, 'shape': " + npy_shape_text(shape) + ", }";
  constexpr std::size_t kPrefix = 10;
  text.append(63 - (kPrefix + text.size()) % 64, ' ');
  text += '\n';

  std::string bytes("\x93NUMPY");
  bytes += {'\x01', '\x00', static_cast<char>(text.size() & 0xff), static_cast<char>(text.size() >> 8)};
  bytes += text;
  bytes.reserve(bytes.size() + values.size() * sizeof(T));
  for (const T value : values) {
    using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
    const Bits bits = same_bits<Bits>(value);
    for (std::size_t i = 0; i < sizeof(T); ++i) bytes += static_cast<char>(bits >> (8 * i) & 0xff);
  }
  return bytes;
}

}  // namespace

Result<NpyLayout> npy_layout(std::string_view head, std::uint64_t file_bytes, const std::string& name) {
  const auto bad = [&name](const std::string& what) { return Error{what, name, 0, 0, ""}; };
  const Result<NpyHeader> header = npy_header(head, name);
  if (!header) return header.error();
  Result<NpyLayout> layout = NpyLayout{*header, {}, 0};
  const std::string shape = npy_shape_text(layout->shape);
  if (layout->is_structured()) return bad("the NPY array is structured, and its fields are no columns of one array");
  const auto type = npy_number_type(layout->dtype);
  if (!type) return bad("the NPY array's type " + quote(layout->dtype) + " is none of f4, f8, i1 to i8, u1 to u8");
  layout->type = *type;
  if (layout->shape.empty() || layout->shape.size() > 2)
    return bad("the NPY array's shape is " + shape + "; expected one or two dimensions");

  // The shape must agree with the number of bytes in the file; multiply without overflow.
  const std::uint64_t data_bytes = file_bytes - layout->data_begin;
  layout->count = 1;
  bool too_many = false;
  for (const std::int64_t extent : layout->shape) {
    const auto factor = static_cast<std::uint64_t>(extent);
    if (factor != 0 && layout->count > std::numeric_limits<std::uint64_t>::max() / 8 / factor) too_many = true;
    if (!too_many) layout->count *= factor;
  }
  if (too_many || layout->count * type->size != data_bytes)
    return bad("the NPY array's shape " + shape + " of " + layout->dtype + " does not agree with the " +
               std::to_string(data_bytes) + " bytes of numbers in the file");
  return layout;
}

Result<NpyArray> parse_npy(std::string_view bytes, const std::string& name) {
  const auto bad = [&name](const std::string& what) { return Error{what, name, 0, 0, ""}; };
  Result<NpyLayout> header = npy_layout(bytes, bytes.size(), name);
  if (!header) return header.error();
  const NumberType type = header->type;
  const std::uint64_t count = header->count;
  const std::string shape = npy_shape_text(header->shape);
  if (Status status = check_memory(static_cast<double>(count) * sizeof(double), "the NPY array of shape " + shape);
      !status)
    return bad(status.error().message);

  // Bring the numbers into C order. Without numbers a side of the shape may still be huge.
  NpyArray array;
  array.shape = header->shape;
  array.dtype = header->dtype;
  if (count == 0) return array;
  array.values.resize(static_cast<std::size_t>(count));
  const auto columns = static_cast<std::size_t>(header->shape.size() == 2 ? header->shape[1] : 1);
  const auto rows = static_cast<std::size_t>(header->shape[0]);
  const char* at = bytes.data() + header->data_begin;
  if (header->fortran_order) {
    for (std::size_t column = 0; column < columns; ++column)
      for (std::size_t row = 0; row < rows; ++row, at += type.size)
        array.values[row * columns + column] = number_at(at, type);
  } else {
    for (std::size_t i = 0; i < array.values.size(); ++i, at += type.size) array.values[i] = number_at(at, type);
  }
  return array;
}

std::string npy_bytes(const std::vector<float>& values, const std::vector<std::int64_t>& shape) {
  return bytes_of(values, shape, "<f4");
}
std::string npy_bytes(const std::vector<double>& values, const std::vector<std::int64_t>& shape) {
  return bytes_of(values, shape, "<f8");
}
std::string npy_bytes(const std::vector<std::int64_t>& values, const std::vector<std::int64_t>& shape) {
  return bytes_of(values, shape, "<i8");
}

}  // namespace bihive
