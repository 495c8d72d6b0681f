// Magic, version, length of the header, then a Python dictionary literal with exactly the keys descr, fortran_order and
// shape.
#include "bihive/io/formats/points/npy_header.h"

#include <algorithm>
#include <utility>

#include "bihive/base/parse_number.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

constexpr std::string_view kNpyMagic = "\x93NUMPY";

// Fields of structured types may be structured.
constexpr int kMostDepth = 8;
constexpr std::size_t kMostFields = 1000;

// Reads the header's dictionary: the part of Python's syntax that NumPy writes, in any order and spacing.
class DictionaryParser {
 public:
  explicit DictionaryParser(std::string_view text) : text_(text) {}

  // False if the text is not such a dictionary.
  bool parse(NpyHeader& header) {
    bool has_dtype = false, has_order = false, has_shape = false;
    if (!take('{')) return false;
    while (!take('}')) {
      std::string key;
      if (!take_string(key) || !take(':')) return false;
      if (key == "descr" && !has_dtype)
        has_dtype = is_next('[') ? take_fields("", header.fields, 0) : take_string(header.dtype);
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
  // "[('x', '<f4'), (('a title', 'y'), '<f4', (3,)), ('inner', [('a', '<i2')])]", of which the inner names get the
  // outer one before them.
  bool take_fields(const std::string& outer, std::vector<NpyField>& fields, int depth) {
    if (depth > kMostDepth || !take('[')) return false;
    while (!take(']')) {
      NpyField field;
      std::string name;
      if (fields.size() >= kMostFields || !take('(') || !take_name(name) || !take(',')) return false;
      field.name = outer + name;
      const bool is_structured = is_next('[');
      if (is_structured ? !take_fields(field.name + ".", fields, depth + 1) : !take_string(field.dtype)) return false;
      if (take(',') && is_next('(') && !take_tuple(field.shape)) return false;
      if (!take(')')) return false;
      // Structures that come several times in a row are not read.
      if (is_structured && !field.shape.empty()) return false;
      if (!is_structured) fields.push_back(std::move(field));
      if (!take(',') && !is_next(']')) return false;
    }
    return true;
  }
  // A name, or a title and a name.
  bool take_name(std::string& name) {
    std::string title;
    if (!is_next('(')) return take_string(name);
    return take('(') && take_string(title) && take(',') && take_string(name) && (take(',') || true) && take(')');
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
      // Python 2 wrote long integers as 4L.
      if (!text_.empty() && text_[0] == 'L') text_.remove_prefix(1);
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

}  // namespace

Result<NpyHeader> npy_header(std::string_view bytes, const std::string& name) {
  const auto bad = [&name](const std::string& what) { return Error{what, name, 0, 0, ""}; };
  if (bytes.substr(0, kNpyMagic.size()) != kNpyMagic)
    return bad("this is no NPY file: it does not begin with \\x93NUMPY");
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
  NpyHeader header;
  if (!DictionaryParser(text).parse(header))
    return bad("the NPY header is not what NumPy writes: " + quote(trim(text)));
  header.data_begin = text_begin + static_cast<std::size_t>(length);
  return header;
}

std::optional<NumberType> npy_number_type(std::string_view dtype) {
  if (dtype.size() != 3) return std::nullopt;
  const char order = dtype[0], kind = dtype[1], digit = dtype[2];
  const bool floating = kind == 'f' && (digit == '4' || digit == '8');
  const bool whole = (kind == 'i' || kind == 'u') && (digit == '1' || digit == '2' || digit == '4' || digit == '8');
  const bool has_order = order == '<' || order == '>' || order == '=' || (order == '|' && digit == '1');
  if (!(floating || whole) || !has_order) return std::nullopt;
  return NumberType{kind, static_cast<std::size_t>(digit - '0'), order == '>'};
}

std::string npy_shape_text(const std::vector<std::int64_t>& shape) {
  std::string text = "(";
  for (std::size_t i = 0; i < shape.size(); ++i) text += (i ? ", " : "") + std::to_string(shape[i]);
  return text + (shape.size() == 1 ? ",)" : ")");
}

}  // namespace bihive
