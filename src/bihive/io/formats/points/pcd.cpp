// Point clouds of PCL [PCD]: a header of keywords, then one line for each point, or its bytes, or all bytes packed by
// LZF.
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <vector>

#include "bihive/base/memory.h"
#include "bihive/base/parse_number.h"
#include "bihive/io/formats/formats.h"
#include "bihive/io/formats/points/lzf.h"
#include "bihive/io/packed/binary_number.h"
#include "bihive/io/text/fields.h"
#include "bihive/io/text/sphere_table.h"

namespace bihive {
namespace {

struct PcdField {
  std::string name;
  NumberType type;
  std::int64_t count = 1;
  std::size_t begin = 0;  // bytes of the fields before it, in one point
};

class PcdReader {
 public:
  PcdReader(std::string_view bytes, const std::string& file, const ColumnChoice& choice)
      : bytes_(bytes), scanner_(bytes, file), choice_(choice) {}

  Result<RawSpheres> read() {
    if (Status head = read_header(); !head) return head.error();
    if (Status fields = describe_fields(); !fields) return fields.error();
    if (const std::string fault = choose_columns(choice_, columns_); !fault.empty())
      return scanner_.line_error(fault + " in FIELDS");
    SphereTable table(columns_);
    if (const std::string fault = table.columns_fault(); !fault.empty())
      return scanner_.line_error(fault + " in FIELDS", how_to_name_columns());
    if (has_rgb_) table.colours_are_bytes();
    table.reserve(points_, scanner_.bytes_left());
    if (Status points = data_ == "ascii" ? read_text(table) : read_binary(table); !points) return points.error();
    const std::string names = table.column_names();
    RawSpheres spheres = std::move(table).take();
    spheres.format = "PCD";
    spheres.rules.insert(spheres.rules.begin(), "fields: " + names);
    if (without_place_ > 0)
      spheres.rules.push_back("points without a place (NaN) are left out: " + std::to_string(without_place_));
    return spheres;
  }

 private:
  Status read_header() {
    std::string_view word;
    scanner_.set_comment('#');
    while (scanner_.next_line()) {
      if (!scanner_.next_field(word)) continue;
      const std::string keyword(word);
      if (!seen_.insert(keyword).second) return scanner_.line_error(quote(keyword) + " comes twice");
      std::vector<std::string>* words = nullptr;
      if (keyword == "FIELDS" || keyword == "COLUMNS") words = &names_;
      if (keyword == "SIZE") words = &sizes_;
      if (keyword == "TYPE") words = &types_;
      if (keyword == "COUNT") words = &counts_;
      if (words) {
        while (words->size() <= SphereTable::kMostColumns && scanner_.next_field(word)) words->emplace_back(word);
      } else if (keyword == "WIDTH" || keyword == "HEIGHT" || keyword == "POINTS") {
        const Result<std::int64_t> count = take_count(scanner_, "a whole number for " + keyword);
        if (!count) return count.error();
        (keyword == "WIDTH" ? width_ : keyword == "HEIGHT" ? height_ : points_) = *count;
      } else if (keyword == "DATA") {
        if (!scanner_.next_field(word) || (word != "ascii" && word != "binary" && word != "binary_compressed"))
          return scanner_.field_error("expected ascii, binary or binary_compressed but found " + quote(word));
        data_ = std::string(word);
        scanner_.set_comment(0);
        return Done{};
      } else if (keyword != "VERSION" && keyword != "VIEWPOINT") {
        return scanner_.line_error("expected FIELDS, SIZE, TYPE, COUNT, WIDTH, HEIGHT, POINTS or DATA but found " +
                                   quote(keyword));
      }
    }
    return scanner_.line_error("the file ends in its header: expected 'DATA'");
  }

  Status describe_fields() {
    const auto bad = [this](const std::string& what) { return Status(scanner_.line_error(what + " in the header")); };
    if (names_.empty()) return bad("there is no line FIELDS");
    const std::size_t count = names_.size();
    if (sizes_.size() != count || types_.size() != count || (!counts_.empty() && counts_.size() != count))
      return bad("FIELDS, SIZE, TYPE and COUNT name different numbers of fields");
    if (points_ < 0)
      points_ = width_ >= 0 && height_ >= 0 && width_ < (1 << 30) && height_ < (1 << 30) ? width_ * height_ : -1;
    if (points_ < 0) return bad("there is no line POINTS");
    const auto has = [this](std::string_view name) {
      return std::any_of(names_.begin(), names_.end(), [name](const auto& one) { return lower_case(one) == name; });
    };
    const bool r_g_b = has("r") && has("g") && has("b");
    for (std::size_t i = 0; i < count; ++i) {
      PcdField field;
      field.name = names_[i];
      const auto size = parse_int(sizes_[i]);
      const auto values = counts_.empty() ? std::optional<std::int64_t>(1) : parse_int(counts_[i]);
      const char kind = types_[i] == "F" ? 'f' : types_[i] == "I" ? 'i' : types_[i] == "U" ? 'u' : '\0';
      const bool known = size && (*size == 4 || *size == 8 || ((*size == 1 || *size == 2) && kind != 'f'));
      if (!kind || !known)
        return bad("the field " + quote(field.name) + " has TYPE " + quote(types_[i]) + " and SIZE " +
                   quote(sizes_[i]) + ", which is no number");
      if (!values || *values < 1 || *values > static_cast<std::int64_t>(SphereTable::kMostColumns))
        return bad("the field " + quote(field.name) + " has COUNT " + quote(counts_[i]));
      field.type = {kind, static_cast<std::size_t>(*size), false};
      field.count = *values;
      field.begin = point_bytes_;
      point_bytes_ += static_cast<std::size_t>(field.count) * field.type.size;
      add_columns(field, r_g_b);
      if (columns_.size() > SphereTable::kMostColumns) return bad("there are more than 1000 columns");
      fields_.push_back(std::move(field));
    }
    return Done{};
  }

  static bool is_packed_colour(const PcdField& field) {
    return (field.name == "rgb" || field.name == "rgba") && field.type.size == 4 && field.count == 1;
  }

  void add_columns(const PcdField& field, bool r_g_b) {
    if (is_packed_colour(field)) {
      has_rgb_ = true;
      columns_.push_back({"red", ColumnRole::red});
      columns_.push_back({"green", ColumnRole::green});
      columns_.push_back({"blue", ColumnRole::blue});
      return;
    }
    if (field.count > 1) {
      const ColumnRole role = field.name == "_" ? ColumnRole::ignored : ColumnRole::number;
      for (std::int64_t i = 1; i <= field.count; ++i) columns_.push_back({field.name + "_" + std::to_string(i), role});
      return;
    }
    ColumnRole role = field.name == "_" ? ColumnRole::ignored : usual_role(field.name);
    if (r_g_b && field.name == "r") role = ColumnRole::red;
    if (r_g_b && field.name == "g") role = ColumnRole::green;
    if (r_g_b && field.name == "b") role = ColumnRole::blue;
    columns_.push_back({field.name, role});
  }

  // 0xRRGGBB, as a whole number or as the bits of a float.
  static void add_colour(std::uint32_t bits, std::vector<double>& row) {
    for (const int shift : {16, 8, 0}) row.push_back(double(bits >> shift & 0xff));
  }

  // Adds a point, unless it has no place.
  std::string add(SphereTable& table, const std::vector<double>& row) {
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const ColumnRole role = columns_[i].role;
      if ((role == ColumnRole::x || role == ColumnRole::y || role == ColumnRole::z) && std::isnan(row[i])) {
        ++without_place_;
        return "";
      }
    }
    return table.add_numbers(row.data());
  }

  Status read_text(SphereTable& table) {
    std::vector<double> row;
    for (std::int64_t i = 0; i < points_; ++i) {
      if (!scanner_.next_filled_line()) return cut(i);
      row.clear();
      for (const PcdField& field : fields_)
        for (std::int64_t k = 0; k < field.count; ++k) {
          std::string_view text;
          scanner_.next_field(text);
          const auto value = parse_double(text);
          if (!value)
            return scanner_.field_error("expected a number for " + printable(field.name) + " but found " + quote(text));
          if (!is_packed_colour(field))
            row.push_back(*value);
          else if (field.type.kind == 'f')
            add_colour(std::abs(*value) < 3e38 ? same_bits<std::uint32_t>(static_cast<float>(*value)) : 0, row);
          else
            add_colour(static_cast<std::uint32_t>(parse_int(text).value_or(0)), row);
        }
      std::string_view more;
      if (scanner_.next_field(more))
        return scanner_.field_error("expected the end of the line but found " + quote(more));
      if (const std::string fault = add(table, row); !fault.empty()) return scanner_.line_error(fault);
    }
    return Done{};
  }

  Error cut(std::int64_t found) const {
    return scanner_.line_error("the file ends too early: expected " + std::to_string(points_) + " points but found " +
                               std::to_string(found));
  }
  Error bad(const std::string& what) const { return {what, scanner_.file(), 0, 0, ""}; }

  Status read_binary(SphereTable& table) {
    std::string_view body = bytes_.substr(bytes_.size() - static_cast<std::size_t>(scanner_.bytes_left()));
    const auto points = static_cast<std::size_t>(points_);
    const bool packed = data_ != "binary";
    std::string unpacked;
    if (packed) {
      // Two sizes, then the bytes; unpacked they are field by field.
      if (body.size() < 8) return bad("the file ends before the sizes of its packed points");
      const std::uint64_t packed_size = bits_at(body.data(), 4, false), size = bits_at(body.data() + 4, 4, false);
      if (packed_size > body.size() - 8) return bad("the file ends inside of its packed points");
      if (points > size / point_bytes_ || points * point_bytes_ != size)
        return bad("the packed points have " + std::to_string(size) + " bytes, but " + std::to_string(points_) +
                   " points have " + std::to_string(point_bytes_) + " each");
      if (Status status = check_memory(double(size), "what is packed in it"); !status)
        return bad(status.error().message);
      auto bytes = unpack_lzf(body.substr(8, packed_size), size);
      if (!bytes) return bad("the packed points are damaged");
      unpacked = std::move(*bytes);
      body = unpacked;
    } else if (points > body.size() / point_bytes_) {
      return bad("the file ends too early: expected " + std::to_string(points_) + " points of " +
                 std::to_string(point_bytes_) + " bytes but found " + std::to_string(body.size()) + " bytes");
    }
    std::vector<double> row;
    for (std::size_t i = 0; i < points; ++i) {
      row.clear();
      for (const PcdField& field : fields_) {
        const std::size_t width = static_cast<std::size_t>(field.count) * field.type.size;
        const char* const at =
            body.data() + (packed ? field.begin * points + i * width : i * point_bytes_ + field.begin);
        if (is_packed_colour(field))
          add_colour(static_cast<std::uint32_t>(bits_at(at, 4, false)), row);
        else
          for (std::size_t k = 0; k < static_cast<std::size_t>(field.count); ++k)
            row.push_back(number_at(at + k * field.type.size, field.type));
      }
      if (const std::string fault = add(table, row); !fault.empty())
        return bad("point " + std::to_string(i) + " (from 0): " + fault);
    }
    return Done{};
  }

  std::string_view bytes_;
  TextScanner scanner_;
  const ColumnChoice& choice_;
  std::set<std::string> seen_;
  std::vector<std::string> names_, sizes_, types_, counts_;
  std::vector<PcdField> fields_;
  std::vector<TableColumn> columns_;
  std::string data_;
  std::int64_t width_ = -1, height_ = -1, points_ = -1, without_place_ = 0;
  std::size_t point_bytes_ = 0;
  bool has_rgb_ = false;
};

constexpr std::string_view kPcdFiles = ".pcd";

// VERSION may be missing, where the ending tells: the names of FIELDS may be the header of a table.
bool is_pcd(const FileHead& head) {
  if (head.bytes.substr(0, 6) == "# .PCD") return true;
  TextScanner scanner(head.bytes, "");
  scanner.set_comment('#');
  const auto begins_with = [&scanner](std::string_view keyword) {
    return scanner.line().substr(0, keyword.size() + 1) == std::string(keyword) + ' ';
  };
  if (!scanner.next_filled_line()) return false;
  const bool has_version = begins_with("VERSION");
  if (has_version && !scanner.next_filled_line()) return false;
  return (has_version || is_named_so(kPcdFiles, head.name)) && (begins_with("FIELDS") || begins_with("COLUMNS"));
}

Result<RawSpheres> read_pcd(std::string_view bytes, const std::string& file, std::int64_t frame,
                            const ColumnChoice& choice) {
  if (frame != 0) return no_such_frame(file, frame, 1);
  return PcdReader(bytes, file, choice).read();
}

}  // namespace

extern constexpr Format kPcd(
    "PCD", kPcdFiles, Format::kColumns, is_pcd, read_pcd,
    "`# .PCD`, or `VERSION` and `FIELDS` | points and their numbers, in text, binary and packed | "
    "the file's, else from distances");

}  // namespace bihive
