// The format [NumPy-format]: magic, version, length of the header, a Python dictionary literal with exactly the keys
// descr, fortran_order and shape, then the numbers.
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

constexpr std::string_view kMagic = "\x93NUMPY";

std::string shape_text(const std::vector<std::int64_t>& shape) {
  std::string text = "(";
  for (std::size_t i = 0; i < shape.size(); ++i) text += (i ? ", " : "") + std::to_string(shape[i]);
  return text + (shape.size() == 1 ? ",)" : ")");
}

// Reads the header's dictionary: the part of Python's syntax that NumPy writes, in any order and spacing.
class DictionaryParser {
 public:
  explicit DictionaryParser(std::string_view text) : text_(text) {}

  // False if the text is not such a dictionary.
  bool parse(NpyLayout& header) {
    bool has_dtype = false, has_order = false, has_shape = false;
    if (!take('{')) return false;
    while (!take('}')) {
      std::string key;
      if (!take_string(key) || !take(':')) return false;
      if (key == "descr" && !has_dtype)
        has_dtype = take_string(header.dtype);
      else if (key == "fortran_order" && !has_order)
        has_order = take_bool(header.fortran_order);
      else if (key == "shape" && !has_shape)
        has_shape = take_tuple(header.shape);
      else
        return false;
      if (!take(',') && !is_next('}')) return false;
    }
    skip_blanks();
    return text_.empty() && has_dtype && has_order && has_shape;
  }

 private:
  void skip_blanks() {
    while (!text_.empty() && (text_[0] == ' ' || text_[0] == '\n' || text_[0] == '\t')) text_.remove_prefix(1);
  }
  bool is_next(char c) {
    skip_blanks();
    return !text_.empty() && text_[0] == c;
  }
  bool take(char c) {
    if (!is_next(c)) return false;
    text_.remove_prefix(1);
    return true;
  }
  bool take_string(std::string& value) {
    const char mark = is_next('"') ? '"' : '\'';
    if (!take(mark)) return false;
    const std::size_t end = text_.find(mark);
    if (end == std::string_view::npos) return false;
    value = text_.substr(0, end);
    text_.remove_prefix(end + 1);
    return true;
  }
  bool take_bool(bool& value) {
    skip_blanks();
    for (const bool candidate : {true, false}) {
      const std::string_view word = candidate ? "True" : "False";
      if (text_.substr(0, word.size()) != word) continue;
      text_.remove_prefix(word.size());
      value = candidate;
      return true;
    }
    return false;
  }
  bool take_tuple(std::vector<std::int64_t>& values) {
    if (!take('(')) return false;
    while (!take(')')) {
      skip_blanks();
      const std::size_t end = std::min(text_.find_first_not_of("0123456789"), text_.size());
      const auto value = parse_int(text_.substr(0, end));
      if (!value) return false;
      values.push_back(*value);
      text_.remove_prefix(end);
      if (!take(',') && !is_next(')')) return false;
    }
    return true;
  }

  std::string_view text_;
};

std::uint64_t little_endian(std::string_view bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

Result<NpyLayout> parse_header(std::string_view bytes, const std::string& name) {
  const auto bad = [&name](const std::string& what) { return Error{what, name, 0, 0, ""}; };
  if (bytes.substr(0, kMagic.size()) != kMagic) return bad("this is no NPY file: it does not begin with \\x93NUMPY");
  if (bytes.size() < 8) return bad("the NPY header is cut");

  // Version 1 has two bytes for the header's length, versions 2 and 3 have four.
  const int version = static_cast<unsigned char>(bytes[6]);
  if (version < 1 || version > 3)
    return bad("NPY version " + std::to_string(version) + " is unknown (1 to 3 are read)");
  const std::size_t length_bytes = version == 1 ? 2 : 4;
  const std::size_t text_begin = 8 + length_bytes;
  if (bytes.size() < text_begin) return bad("the NPY header is cut");
  const std::uint64_t length = little_endian(bytes.substr(8, length_bytes));
  if (length > bytes.size() - text_begin) return bad("the NPY header is cut");

  const std::string_view text = bytes.substr(text_begin, static_cast<std::size_t>(length));
  NpyLayout header;
  if (!DictionaryParser(text).parse(header))
    return bad("the NPY header is not what NumPy writes: " + quote(trim(text)));
  header.data_begin = text_begin + static_cast<std::size_t>(length);
  return header;
}

std::optional<NumberType> number_type(std::string_view dtype) {
  if (dtype.size() != 3) return std::nullopt;
  const char order = dtype[0], kind = dtype[1], digit = dtype[2];
  const bool floating = kind == 'f' && (digit == '4' || digit == '8');
  const bool whole = (kind == 'i' || kind == 'u') && (digit == '1' || digit == '2' || digit == '4' || digit == '8');
  const bool has_order = order == '<' || order == '>' || order == '=' || (order == '|' && digit == '1');
  if (!(floating || whole) || !has_order) return std::nullopt;
  return NumberType{kind, static_cast<std::size_t>(digit - '0'), order == '>'};
}

template <class T>
std::string bytes_of(const std::vector<T>& values, const std::vector<std::int64_t>& shape, const char* dtype) {
  std::int64_t count = 1;
  for (const std::int64_t extent : shape) count *= extent;
  BIHIVE_CHECK_EQ(count, static_cast<std::int64_t>(values.size()));

  // Pad the header with blanks so that the numbers begin at a multiple of 64 bytes.
  std::string text =
      "{'descr': '" + std::string(dtype) + "', 'fortran_order': False, 'shape': " + shape_text(shape) + ", }";
  constexpr std::size_t kPrefix = 10;
  text.append(63 - (kPrefix + text.size()) % 64, ' ');
  text += '\n';

  std::string bytes(kMagic);
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
  Result<NpyLayout> layout = parse_header(head, name);
  if (!layout) return layout.error();
  const std::string shape = shape_text(layout->shape);
  const auto type = number_type(layout->dtype);
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
  const std::string shape = shape_text(header->shape);
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
