// VTK's old format [VTK-format]: a mark, a title, ASCII or BINARY (big endian), then keywords with arrays behind them.
// The points of POLYDATA, UNSTRUCTURED_GRID and STRUCTURED_GRID become spheres.
#include <optional>

#include "bihive/base/memory.h"
#include "bihive/base/parse_number.h"
#include "bihive/io/formats/format.h"
#include "bihive/io/formats/points/vtk_arrays.h"
#include "bihive/io/packed/binary_number.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

constexpr std::int64_t kMostNumbers = std::int64_t{1} << 40;

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f';
}

// The values of an array: numbers, single bits, or texts.
struct ArrayType {
  enum class Kind { numbers, bits, texts };
  NumberType number;
  Kind kind = Kind::numbers;
};

std::optional<ArrayType> vtk_type(std::string_view name) {
  const std::string lower = lower_case(name);
  if (lower == "bit") return ArrayType{{'u', 1, true}, ArrayType::Kind::bits};
  if (lower == "string" || lower == "utf8_string" || lower == "variant")
    return ArrayType{{'u', 1, true}, ArrayType::Kind::texts};
  struct Named {
    std::string_view name;
    NumberType type;
  };
  static constexpr Named names[] = {
      {"float", {'f', 4}},         {"double", {'f', 8}},        {"int", {'i', 4}},       {"unsigned_int", {'u', 4}},
      {"char", {'i', 1}},          {"unsigned_char", {'u', 1}}, {"short", {'i', 2}},     {"unsigned_short", {'u', 2}},
      {"long", {'i', 8}},          {"unsigned_long", {'u', 8}}, {"vtkidtype", {'i', 4}}, {"vtktypeint64", {'i', 8}},
      {"vtktypeuint64", {'u', 8}}, {"signed_char", {'i', 1}}};
  for (const Named& one : names)
    if (lower == one.name) {
      ArrayType type{one.type};
      type.number.big_endian = true;
      return type;
    }
  return std::nullopt;
}

class VtkReader {
 public:
  VtkReader(std::string_view bytes, const std::string& file, const ColumnChoice& choice)
      : bytes_(bytes), file_(file), choice_(choice) {}

  Result<RawSpheres> read() {
    if (Status status = read_all(); !status) return status.error();
    if (!has_points_) return error("there are no POINTS in it", kHint);
    return spheres_of_arrays(places_, arrays_, left_out_, file_, choice_);
  }

 private:
  static constexpr const char* kHint = "datasets with POINTS are read: POLYDATA, UNSTRUCTURED_GRID, STRUCTURED_GRID";

  Error error(const std::string& message, const std::string& hint = "") const {
    return {message, file_, line_, 0, hint};
  }

  std::string_view rest_of_line() {
    const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
    const std::string_view line = bytes_.substr(at_, end - at_);
    at_ = std::min(end + 1, bytes_.size());
    ++line_;
    return trim(line);
  }

  // The next word; empty at the end.
  std::string_view word() {
    while (at_ < bytes_.size() && is_space(bytes_[at_])) line_ += bytes_[at_++] == '\n';
    const std::size_t begin = at_;
    while (at_ < bytes_.size() && !is_space(bytes_[at_])) ++at_;
    return bytes_.substr(begin, at_ - begin);
  }

  Result<std::int64_t> count(const std::string& what) {
    const std::string_view field = word();
    const auto number = parse_int(field);
    if (!number || *number < 0 || *number > kMostNumbers)
      return error("expected " + what + " but found " + quote(field));
    return *number;
  }

  Result<ArrayType> type() {
    const std::string_view field = word();
    const auto known = vtk_type(field);
    if (!known) return error("the type of numbers " + quote(field) + " is not read");
    return *known;
  }

  // The values of an array, from the present line's end; `values` may be nullptr, and texts give none.
  Status numbers(std::int64_t tuples, std::int64_t components, const ArrayType& of, std::vector<double>* values) {
    const NumberType& type = of.number;
    if (components > 1000 || tuples > kMostNumbers / std::max<std::int64_t>(components, 1))
      return error("an array of " + std::to_string(tuples) + " x " + std::to_string(components) +
                   " numbers is too large");
    const auto total = static_cast<std::size_t>(tuples * components);
    const auto cut = [&] { return error("the file ends inside of an array of " + std::to_string(total) + " numbers"); };
    if (of.kind == ArrayType::Kind::texts) return skip_texts(total) ? Status(Done{}) : cut();
    if (!binary_) {
      if (total > (bytes_.size() - at_) / 2 + 1) return cut();
      if (values) values->reserve(total);
      for (std::size_t i = 0; i < total; ++i) {
        const std::string_view field = word();
        if (field.empty()) return cut();
        const auto number = parse_double(field);
        if (!number) return error("expected a number but found " + quote(field));
        if (values) values->push_back(*number);
      }
      return Done{};
    }
    rest_of_line();
    const bool are_bits = of.kind == ArrayType::Kind::bits;
    const std::size_t size = are_bits ? (total + 7) / 8 : total;
    if (size > (bytes_.size() - at_) / type.size) return cut();
    if (values) {
      if (Status memory = check_memory(double(total) * sizeof(double), "an array of the file"); !memory)
        return error(memory.error().message);
      values->reserve(total);
      const char* const begin = bytes_.data() + at_;
      for (std::size_t i = 0; i < total; ++i)
        values->push_back(are_bits ? double(static_cast<unsigned char>(begin[i / 8]) >> (7 - i % 8) & 1)
                                   : number_at(begin + i * type.size, type));
    }
    at_ += size * type.size;
    return Done{};
  }

  // Each text on a line, or in binary behind its length. False at the end of the file.
  bool skip_texts(std::size_t count) {
    if (count > bytes_.size() - at_) return false;
    rest_of_line();
    for (std::size_t i = 0; i < count; ++i) {
      if (at_ >= bytes_.size()) return false;
      if (!binary_) {
        rest_of_line();
        continue;
      }
      // The first two bits tell how many bytes the length has: 8, 4, 2 or 1.
      const int kind = static_cast<unsigned char>(bytes_[at_]) >> 6;
      const std::size_t width = std::size_t{8} >> kind;
      if (width > bytes_.size() - at_) return false;
      const std::uint64_t mask = ~std::uint64_t{0} >> (66 - 8 * width);
      const std::uint64_t length = bits_at(bytes_.data() + at_, width, true) & mask;
      at_ += width;
      if (length > bytes_.size() - at_) return false;
      at_ += static_cast<std::size_t>(length);
    }
    return true;
  }

  // Reads an array; keeps it if it belongs to the points.
  Status array(std::string_view name, std::int64_t tuples, std::int64_t components, const ArrayType& type) {
    const bool is_text = type.kind == ArrayType::Kind::texts;
    const bool keep = of_points_ && tuples == points_ && !is_text;
    if (of_points_ && is_text) left_out_ += " " + quote(name);
    PointArray made{printable(name), components, type.number.kind != 'f', {}};
    if (Status status = numbers(tuples, components, type, keep ? &made.values : nullptr); !status) return status;
    if (keep) arrays_.push_back(std::move(made));
    return Done{};
  }

  Status read_all() {
    rest_of_line();
    rest_of_line();
    const std::string_view found = rest_of_line();
    const std::string kind = lower_case(found);
    if (kind != "ascii" && kind != "binary") {
      --line_;
      return error("expected ASCII or BINARY but found " + quote(found));
    }
    binary_ = kind == "binary";
    for (std::string_view keyword = word(); !keyword.empty(); keyword = word())
      if (Status status = section(keyword); !status) return status;
    return Done{};
  }

  // Keywords may be in upper or lower case.
  Status section(std::string_view as_written) {
    const std::string keyword = lower_case(as_written);
    if (keyword == "dataset") {
      const std::string_view kind = word();
      const std::string lower = lower_case(kind);
      if (lower != "polydata" && lower != "unstructured_grid" && lower != "structured_grid")
        return error("the dataset " + quote(kind) + " has no points of its own", kHint);
      return Done{};
    }
    if (keyword == "dimensions" || keyword == "metadata") {
      // Metadata go to the next empty line.
      rest_of_line();
      if (keyword == "metadata")
        while (at_ < bytes_.size() && !rest_of_line().empty()) {
        }
      return Done{};
    }
    if (keyword == "points") return read_points();
    for (const char* const cells : {"vertices", "lines", "polygons", "triangle_strips", "cells"})
      if (keyword == cells) return skip_cells();
    if (keyword == "cell_types") {
      const Result<std::int64_t> cells = count("a number of cells");
      return cells ? numbers(*cells, 1, {{'i', 4, true}}, nullptr) : Status(cells.error());
    }
    if (keyword == "point_data" || keyword == "cell_data") {
      const Result<std::int64_t> tuples = count("the number of points or cells");
      if (!tuples) return tuples.error();
      of_points_ = keyword == "point_data";
      tuples_ = *tuples;
      if (of_points_ && has_points_ && tuples_ != points_)
        return error("POINT_DATA is of " + std::to_string(tuples_) + " points, but there are " +
                     std::to_string(points_));
      return Done{};
    }
    return attribute(keyword, as_written);
  }

  Status read_points() {
    if (has_points_) return error("POINTS come twice");
    const Result<std::int64_t> points = count("the number of points");
    if (!points) return points.error();
    const Result<ArrayType> of = type();
    if (!of) return of.error();
    has_points_ = true;
    points_ = *points;
    if (of->kind != ArrayType::Kind::numbers) return error("points must be numbers");
    return numbers(points_, 3, *of, &places_);
  }

  // "n size" and the numbers; from version 5 on two arrays, OFFSETS and CONNECTIVITY.
  Status skip_cells() {
    const Result<std::int64_t> cells = count("a number of cells");
    if (!cells) return cells.error();
    const Result<std::int64_t> size = count("a number of indices");
    if (!size) return size.error();
    const std::size_t at = at_;
    const std::int64_t line = line_;
    if (lower_case(word()) != "offsets") {
      at_ = at;
      line_ = line;
      return numbers(*size, 1, {{'i', 4, true}}, nullptr);
    }
    const Result<ArrayType> offsets = type();
    if (!offsets) return offsets.error();
    if (Status status = numbers(*cells, 1, *offsets, nullptr); !status) return status;
    if (const std::string_view found = word(); lower_case(found) != "connectivity")
      return error("expected CONNECTIVITY but found " + quote(found));
    const Result<ArrayType> connectivity = type();
    if (!connectivity) return connectivity.error();
    return numbers(*size, 1, *connectivity, nullptr);
  }

  Status attribute(const std::string& keyword, std::string_view as_written) {
    if (keyword == "field") {
      word();
      const Result<std::int64_t> fields = count("a number of arrays");
      if (!fields) return fields.error();
      for (std::int64_t i = 0; i < *fields; ++i) {
        std::string_view name = word();
        if (lower_case(name) == "metadata") {
          while (at_ < bytes_.size() && !rest_of_line().empty()) {
          }
          name = word();
        }
        const Result<std::int64_t> components = count("a number of components");
        if (!components) return components.error();
        const Result<std::int64_t> tuples = count("a number of tuples");
        if (!tuples) return tuples.error();
        const Result<ArrayType> of = type();
        if (!of) return of.error();
        if (Status status = array(name, *tuples, *components, *of); !status) return status;
      }
      return Done{};
    }
    const std::string_view name = word();
    if (keyword == "lookup_table") {
      const Result<std::int64_t> size = count("the size of a table");
      return size ? numbers(*size, 4, {{'u', 1, true}}, nullptr) : Status(size.error());
    }
    if (keyword == "color_scalars") {
      const Result<std::int64_t> components = count("a number of components");
      if (!components) return components.error();
      ArrayType of{{'u', 1, true}};
      if (!binary_) of.number = {'f', 4, true};
      return array("rgb", tuples_, *components, of);
    }
    std::int64_t components = 0;
    if (keyword == "scalars" || keyword == "global_ids" || keyword == "pedigree_ids") components = 1;
    if (keyword == "vectors" || keyword == "normals") components = 3;
    if (keyword == "tensors") components = 9;
    if (keyword == "tensors6") components = 6;
    if (keyword == "texture_coordinates") {
      const Result<std::int64_t> dimensions = count("a number of dimensions");
      if (!dimensions) return dimensions.error();
      components = *dimensions;
    }
    if (components == 0) return error("the keyword " + quote(as_written) + " is unknown");
    const Result<ArrayType> of = type();
    if (!of) return of.error();
    if (keyword == "scalars") {
      // A number of components may follow on the line, then a line with a table may.
      const std::string_view more = rest_of_line();
      if (const auto given = parse_int(more); given && *given > 0) components = *given;
      const std::size_t at = at_;
      const std::int64_t line = line_;
      if (lower_case(word()) == "lookup_table") {
        word();
      } else {
        // Binary numbers begin behind the line's end.
        at_ = at - (binary_ ? 1 : 0);
        line_ = line - (binary_ ? 1 : 0);
      }
    }
    return array(name, tuples_, components, *of);
  }

  std::string_view bytes_;
  const std::string& file_;
  const ColumnChoice& choice_;
  std::size_t at_ = 0;
  std::int64_t line_ = 1;
  bool binary_ = false, has_points_ = false, of_points_ = false;
  std::int64_t points_ = 0, tuples_ = 0;
  std::vector<double> places_;
  std::vector<PointArray> arrays_;
  std::string left_out_;  // arrays of texts
};

Result<RawSpheres> read_vtk_legacy(std::string_view bytes, const std::string& file, std::int64_t frame,
                                   const ColumnChoice& choice) {
  if (frame != 0) return no_such_frame(file, frame, 1);
  return VtkReader(bytes, file, choice).read();
}

}  // namespace

extern constexpr Format kVtk(
    "VTK", ".vtk", Format::kColumns, [](const FileHead& head) { return head.bytes.substr(0, 15) == "# vtk DataFile "; },
    read_vtk_legacy,
    "`# vtk DataFile` | points and their numbers, in text and binary | the file's, else from distances");

}  // namespace bihive
