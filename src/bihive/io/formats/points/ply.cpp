// PLY [PLY]: a header in text that lists elements and their properties, then the elements in text or binary. The
// element "vertex" gives the spheres.
#include <algorithm>
#include <optional>
#include <vector>

#include "bihive/base/parse_number.h"
#include "bihive/io/formats/format.h"
#include "bihive/io/packed/binary_number.h"
#include "bihive/io/text/fields.h"
#include "bihive/io/text/sphere_table.h"

namespace bihive {
namespace {

struct Property {
  std::string name;
  NumberType type;
  std::optional<NumberType> length;  // of a list: its count
};

struct Element {
  std::string name;
  std::int64_t count = 0;
  std::vector<Property> properties;
};

std::optional<NumberType> ply_type(std::string_view name) {
  struct Named {
    std::string_view old_name, new_name;
    NumberType type;
  };
  static constexpr Named names[] = {{"char", "int8", {'i', 1}},     {"uchar", "uint8", {'u', 1}},
                                    {"short", "int16", {'i', 2}},   {"ushort", "uint16", {'u', 2}},
                                    {"int", "int32", {'i', 4}},     {"uint", "uint32", {'u', 4}},
                                    {"float", "float32", {'f', 4}}, {"double", "float64", {'f', 8}}};
  for (const Named& one : names)
    if (name == one.old_name || name == one.new_name) return one.type;
  return std::nullopt;
}

// Names of colours and radii in some programs, beside the usual ones.
ColumnRole role_of_property(const std::string& name, bool rgb) {
  const std::string lower = lower_case(name);
  if (lower == "diffuse_red" || (rgb && lower == "r")) return ColumnRole::red;
  if (lower == "diffuse_green" || (rgb && lower == "g")) return ColumnRole::green;
  if (lower == "diffuse_blue" || (rgb && lower == "b")) return ColumnRole::blue;
  return usual_role(name);
}

class PlyReader {
 public:
  PlyReader(std::string_view bytes, const std::string& file, const ColumnChoice& choice)
      : bytes_(bytes), scanner_(bytes, file), choice_(choice) {}

  Result<RawSpheres> read() {
    if (Status head = read_header(); !head) return head.error();
    body_ = bytes_.size() - static_cast<std::size_t>(scanner_.bytes_left());
    std::string left_out;
    bool done = false;
    for (const Element& element : elements_) {
      if (element.name == "vertex") {
        if (Status status = read_vertices(element); !status) return status.error();
        done = true;
        continue;
      }
      left_out += (left_out.empty() ? "" : ", ") + std::to_string(element.count) + " of " + quote(element.name);
      if (done) continue;
      if (Status status = skip(element); !status) return status.error();
    }
    if (!done) return scanner_.line_error("the header has no 'element vertex', so there are no points");
    spheres_.format = "PLY";
    if (!left_out.empty()) spheres_.rules.push_back("points alone are read; left out: " + left_out);
    return std::move(spheres_);
  }

 private:
  enum class Form { ascii, little, big };

  Status read_header() {
    scanner_.next_line();
    std::optional<Form> form;
    std::string_view word;
    while (scanner_.next_line()) {
      if (!scanner_.next_field(word) || word == "comment" || word == "obj_info") continue;
      if (word == "end_header") {
        if (!form) return scanner_.line_error("expected 'format ascii 1.0' or a binary one in the header");
        form_ = *form;
        return Done{};
      }
      if (word == "format") {
        std::string_view kind, version;
        scanner_.next_field(kind);
        if (form) return scanner_.line_error("the format comes twice");
        if (kind == "ascii")
          form = Form::ascii;
        else if (kind == "binary_little_endian")
          form = Form::little;
        else if (kind == "binary_big_endian")
          form = Form::big;
        else
          return scanner_.field_error("expected ascii, binary_little_endian or binary_big_endian but found " +
                                      quote(kind));
        if (!scanner_.next_field(version) || version != "1.0")
          return scanner_.field_error("expected version 1.0 but found " + quote(version));
      } else if (word == "element") {
        if (Status status = read_element(); !status) return status;
      } else if (word == "property") {
        if (Status status = read_property(); !status) return status;
      } else {
        return scanner_.field_error("expected format, element, property, comment or end_header but found " +
                                    quote(word));
      }
    }
    return scanner_.line_error("the file ends in its header: expected 'end_header'");
  }

  Status read_element() {
    std::string_view name;
    if (!scanner_.next_field(name)) return scanner_.line_error("expected the name of an element");
    for (const Element& other : elements_)
      if (other.name == name) return scanner_.field_error("the element " + quote(name) + " comes twice");
    const Result<std::int64_t> count = take_count(scanner_, "the number of " + quote(name));
    if (!count) return count.error();
    if (elements_.size() > 100) return scanner_.line_error("expected at most 100 elements");
    elements_.push_back({std::string(name), *count, {}});
    return Done{};
  }

  Result<NumberType> take_type() {
    std::string_view name;
    scanner_.next_field(name);
    std::optional<NumberType> type = ply_type(name);
    if (!type) return scanner_.field_error("expected a type (float, double, uchar, int ...) but found " + quote(name));
    return *type;
  }

  Status read_property() {
    if (elements_.empty()) return scanner_.line_error("expected an element before its properties");
    Property property;
    std::string_view word;
    TextScanner ahead(scanner_);
    if (ahead.next_field(word) && word == "list") {
      scanner_.next_field(word);
      const Result<NumberType> length = take_type();
      if (!length) return length.error();
      if (length->kind == 'f') return scanner_.field_error("the length of a list must be a whole number");
      property.length = *length;
    }
    const Result<NumberType> type = take_type();
    if (!type) return type.error();
    property.type = *type;
    if (!scanner_.next_field(word)) return scanner_.line_error("expected the name of a property");
    property.name = std::string(word);
    std::vector<Property>& properties = elements_.back().properties;
    if (properties.size() >= SphereTable::kMostColumns)
      return scanner_.line_error("expected at most " + std::to_string(SphereTable::kMostColumns) + " properties");
    properties.push_back(std::move(property));
    return Done{};
  }

  Status read_vertices(const Element& element) {
    const auto has = [&element](std::string_view wanted) {
      return std::any_of(element.properties.begin(), element.properties.end(),
                         [wanted](const Property& one) { return lower_case(one.name) == wanted; });
    };
    const bool rgb = has("r") && has("g") && has("b");
    std::vector<TableColumn> columns;
    std::vector<bool> whole;  // columns of whole numbers
    bool colours_are_bytes = false;
    for (const Property& property : element.properties) {
      if (property.length) continue;
      columns.push_back({property.name, role_of_property(property.name, rgb)});
      whole.push_back(property.type.kind != 'f');
    }
    if (const std::string fault = choose_columns(choice_, columns); !fault.empty())
      return scanner_.line_error(fault + " in the element 'vertex'");
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (columns[i].role == ColumnRole::red) colours_are_bytes = whole[i];
    SphereTable table(columns);
    if (const std::string fault = table.columns_fault(); !fault.empty())
      return scanner_.line_error(fault + " in the element 'vertex'", how_to_name_columns());
    if (colours_are_bytes) table.colours_are_bytes();
    table.reserve(element.count, static_cast<std::int64_t>(bytes_.size() - body_));
    std::vector<double> row;
    for (std::int64_t i = 0; i < element.count; ++i) {
      row.clear();
      if (Status status = next_row(element, i, &row); !status) return status;
      if (const std::string fault = table.add_numbers(row.data()); !fault.empty())
        return form_ == Form::ascii
                   ? scanner_.line_error(fault)
                   : Error{"point " + std::to_string(i) + " (from 0): " + fault, scanner_.file(), 0, 0, ""};
    }
    const std::string names = table.column_names();
    spheres_ = std::move(table).take();
    spheres_.rules.insert(spheres_.rules.begin(), "properties: " + names);
    return Done{};
  }

  Status skip(const Element& element) {
    if (form_ == Form::ascii && element.properties.empty()) return Done{};
    for (std::int64_t i = 0; i < element.count; ++i) {
      if (element.properties.empty()) break;
      if (Status status = next_row(element, i, nullptr); !status) return status;
    }
    return Done{};
  }

  // Reads one element; its numbers outside of lists go to `row`.
  Status next_row(const Element& element, std::int64_t i, std::vector<double>* row) {
    const auto cut = [&] {
      return scanner_.line_error("the file ends too early: expected " + std::to_string(element.count) + " of " +
                                 quote(element.name) + " but found " + std::to_string(i));
    };
    if (form_ == Form::ascii) {
      if (!scanner_.next_filled_line()) return cut();
      for (const Property& property : element.properties) {
        std::string_view field;
        std::int64_t values = 1;
        if (property.length) {
          const Result<std::int64_t> length = take_count(scanner_, "the length of " + quote(property.name));
          if (!length) return length.error();
          values = *length;
        }
        for (std::int64_t k = 0; k < values; ++k) {
          scanner_.next_field(field);
          const auto value = parse_double(field);
          if (!value)
            return scanner_.field_error("expected a number for " + printable(property.name) + " but found " +
                                        quote(field));
          if (row && !property.length) row->push_back(*value);
        }
      }
      std::string_view more;
      if (scanner_.next_field(more))
        return scanner_.field_error("expected the end of the line but found " + quote(more));
      return Done{};
    }
    for (const Property& property : element.properties) {
      NumberType type = property.type;
      type.big_endian = form_ == Form::big;
      std::uint64_t values = 1;
      if (property.length) {
        NumberType length = *property.length;
        length.big_endian = type.big_endian;
        if (bytes_.size() - body_ < length.size) return cut();
        const double count = number_at(bytes_.data() + body_, length);
        if (count < 0)
          return Error{"the list " + quote(property.name) + " of " + quote(element.name) + " " + std::to_string(i) +
                           " has a negative length",
                       scanner_.file(), 0, 0, ""};
        values = static_cast<std::uint64_t>(count);
        body_ += length.size;
      }
      if (values > (bytes_.size() - body_) / type.size) return cut();
      if (row && !property.length) row->push_back(number_at(bytes_.data() + body_, type));
      body_ += static_cast<std::size_t>(values) * type.size;
    }
    return Done{};
  }

  std::string_view bytes_;
  TextScanner scanner_;
  const ColumnChoice& choice_;
  std::size_t body_ = 0;  // binary: the place of the next byte
  Form form_ = Form::ascii;
  std::vector<Element> elements_;
  RawSpheres spheres_;
};

Result<RawSpheres> read_ply(std::string_view bytes, const std::string& file, std::int64_t frame,
                            const ColumnChoice& choice) {
  if (frame != 0) return no_such_frame(file, frame, 1);
  return PlyReader(bytes, file, choice).read();
}

}  // namespace

extern constexpr Format kPly(
    "PLY", ".ply", Format::kColumns,
    [](const FileHead& head) { return head.bytes.rfind("ply\n", 0) == 0 || head.bytes.rfind("ply\r\n", 0) == 0; },
    read_ply, "`ply` | points and their numbers, in text and binary | the file's, else from distances");

}  // namespace bihive
