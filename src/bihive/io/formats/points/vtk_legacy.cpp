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

std::optional<NumberType> vtk_type(std::string_view name) {
  const std::string lower = lower_case(name);
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
      NumberType type = one.type;
      type.big_endian = true;
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
    return spheres_of_arrays(places_, arrays_, file_, choice_);
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

  Result<NumberType> type() {
    const std::string_view field = word();
    const auto known = vtk_type(field);
    if (!known) return error("the type of numbers " + quote(field) + " is not read");
    return *known;
  }

  // The numbers of an array, from the present line's end; `values` may be nullptr.
  Status numbers(std::int64_t tuples, std::int64_t components, const NumberType& type, std::vector<double>* values) {
    if (components > 1000 || tuples > kMostNumbers / std::max<std::int64_t>(components, 1))
      return error("an array of " + std::to_string(tuples) + " x " + std::to_string(components) +
                   " numbers is too large");
    const auto total = static_cast<std::size_t>(tuples * components);
    const auto cut = [&] { return error("the file ends inside of an array of " + std::to_string(total) + " numbers"); };
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
    if (total > (bytes_.size() - at_) / type.size) return cut();
    if (values) {
      if (Status memory = check_memory(double(total) * sizeof(double), "an array of the file"); !memory)
        return error(memory.error().message);
      values->reserve(total);
      for (std::size_t i = 0; i < total; ++i) values->push_back(number_at(bytes_.data() + at_ + i * type.size, type));
    }
    at_ += total * type.size;
    return Done{};
  }

  // Reads an array; keeps it if it belongs to the points.
  Status array(std::string_view name, std::int64_t tuples, std::int64_t components, const NumberType& type) {
    const bool keep = of_points_ && tuples == points_;
    PointArray made{printable(name), components, type.kind != 'f', {}};
    if (Status status = numbers(tuples, components, type, keep ? &made.values : nullptr); !status) return status;
    if (keep) arrays_.push_back(std::move(made));
    return Done{};
  }

  Status read_all() {
    rest_of_line();
    rest_of_line();
    const std::string_view kind = rest_of_line();
    if (kind != "ASCII" && kind != "BINARY") --line_;
    if (kind != "ASCII" && kind != "BINARY") return error("expected ASCII or BINARY but found " + quote(kind));
    binary_ = kind == "BINARY";
    for (std::string_view keyword = word(); !keyword.empty(); keyword = word())
      if (Status status = section(keyword); !status) return status;
    return Done{};
  }

  Status section(std::string_view keyword) {
    if (keyword == "DATASET") {
      const std::string_view kind = word();
      if (kind != "POLYDATA" && kind != "UNSTRUCTURED_GRID" && kind != "STRUCTURED_GRID")
        return error("the dataset " + quote(kind) + " has no points of its own", kHint);
      return Done{};
    }
    if (keyword == "DIMENSIONS" || keyword == "METADATA") {
      // Metadata go to the next empty line.
      rest_of_line();
      if (keyword == "METADATA")
        while (at_ < bytes_.size() && !rest_of_line().empty()) {
        }
      return Done{};
    }
    if (keyword == "POINTS") return read_points();
    for (const char* const cells : {"VERTICES", "LINES", "POLYGONS", "TRIANGLE_STRIPS", "CELLS"})
      if (keyword == cells) return skip_cells();
    if (keyword == "CELL_TYPES") {
      const Result<std::int64_t> cells = count("a number of cells");
      return cells ? numbers(*cells, 1, {'i', 4, true}, nullptr) : Status(cells.error());
    }
    if (keyword == "POINT_DATA" || keyword == "CELL_DATA") {
      const Result<std::int64_t> tuples = count("the number of points or cells");
      if (!tuples) return tuples.error();
      of_points_ = keyword == "POINT_DATA";
      tuples_ = *tuples;
      if (of_points_ && has_points_ && tuples_ != points_)
        return error("POINT_DATA is of " + std::to_string(tuples_) + " points, but there are " +
                     std::to_string(points_));
      return Done{};
    }
    return attribute(keyword);
  }

  Status read_points() {
    if (has_points_) return error("POINTS come twice");
    const Result<std::int64_t> points = count("the number of points");
    if (!points) return points.error();
    const Result<NumberType> of = type();
    if (!of) return of.error();
    has_points_ = true;
    points_ = *points;
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
    if (word() != "OFFSETS") {
      at_ = at;
      line_ = line;
      return numbers(*size, 1, {'i', 4, true}, nullptr);
    }
    const Result<NumberType> offsets = type();
    if (!offsets) return offsets.error();
    if (Status status = numbers(*cells, 1, *offsets, nullptr); !status) return status;
    if (const std::string_view found = word(); found != "CONNECTIVITY")
      return error("expected CONNECTIVITY but found " + quote(found));
    const Result<NumberType> connectivity = type();
    if (!connectivity) return connectivity.error();
    return numbers(*size, 1, *connectivity, nullptr);
  }

  Status attribute(std::string_view keyword) {
    if (keyword == "FIELD") {
      word();
      const Result<std::int64_t> fields = count("a number of arrays");
      if (!fields) return fields.error();
      for (std::int64_t i = 0; i < *fields; ++i) {
        std::string_view name = word();
        if (name == "METADATA") {
          while (at_ < bytes_.size() && !rest_of_line().empty()) {
          }
          name = word();
        }
        const Result<std::int64_t> components = count("a number of components");
        if (!components) return components.error();
        const Result<std::int64_t> tuples = count("a number of tuples");
        if (!tuples) return tuples.error();
        const Result<NumberType> of = type();
        if (!of) return of.error();
        if (Status status = array(name, *tuples, *components, *of); !status) return status;
      }
      return Done{};
    }
    const std::string_view name = word();
    if (keyword == "LOOKUP_TABLE") {
      const Result<std::int64_t> size = count("the size of a table");
      return size ? numbers(*size, 4, {'u', 1, true}, nullptr) : Status(size.error());
    }
    if (keyword == "COLOR_SCALARS") {
      const Result<std::int64_t> components = count("a number of components");
      if (!components) return components.error();
      NumberType of{'u', 1, true};
      if (!binary_) of = {'f', 4, true};
      return array("rgb", tuples_, *components, of);
    }
    std::int64_t components = 0;
    if (keyword == "SCALARS" || keyword == "GLOBAL_IDS" || keyword == "PEDIGREE_IDS") components = 1;
    if (keyword == "VECTORS" || keyword == "NORMALS") components = 3;
    if (keyword == "TENSORS") components = 9;
    if (keyword == "TENSORS6") components = 6;
    if (keyword == "TEXTURE_COORDINATES") {
      const Result<std::int64_t> dimensions = count("a number of dimensions");
      if (!dimensions) return dimensions.error();
      components = *dimensions;
    }
    if (components == 0) return error("the keyword " + quote(keyword) + " is unknown");
    const Result<NumberType> of = type();
    if (!of) return of.error();
    if (keyword == "SCALARS") {
      // A number of components may follow on the line, then a line with a table may.
      const std::string_view more = rest_of_line();
      if (const auto given = parse_int(more); given && *given > 0) components = *given;
      const std::size_t at = at_;
      const std::int64_t line = line_;
      if (word() == "LOOKUP_TABLE") {
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
