// GRO, fixed columns [GRO]: a title, a count, one line for each atom, and the box; repeated for every frame. Lengths in
// nanometres, which become Angstrom. The distance between decimal points tells how wide the coordinates are.
#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "bihive/base/parse_number.h"
#include "bihive/io/formats/format.h"
#include "bihive/io/formats/molecules/atom_columns.h"
#include "bihive/io/formats/molecules/pdb_elements.h"
#include "bihive/io/text/text_scanner.h"
#include "bihive/io/text/title.h"

namespace bihive {
namespace {

constexpr double kAngstromOfNm = 10;
// Residue's number and name, atom's name and number, five columns each.
constexpr std::size_t kNamesWidth = 20;

// The columns of one coordinate, or nothing if the line shows no two decimal points.
std::optional<std::size_t> width_of(std::string_view line) {
  const std::size_t first = line.find('.', std::min(kNamesWidth, line.size()));
  if (first == std::string_view::npos) return std::nullopt;
  const std::size_t second = line.find('.', first + 1);
  if (second == std::string_view::npos) return std::nullopt;
  return second - first;
}

class GroReader {
 public:
  GroReader(const TextScanner& scanner, const FramePass& pass) : scanner_(scanner), pass_(pass), wanted_(pass.wanted) {
    spheres_.format = "GRO";
  }

  Result<RawSpheres> read() {
    FrameNotes notes(pass_.made, scanner_);
    std::int64_t frames = pass_.first;
    for (; next_frame(); ++frames, notes.end_frame(scanner_))
      if (Status status = read_frame(frames); !status) return status.error();
    if (pass_.reads_none()) return std::move(spheres_);
    if (wanted_ < 0 || wanted_ >= frames) return no_such_frame(scanner_.file(), wanted_, frames);
    finish(pass_.index != nullptr ? pass_.index->count() : frames);
    return std::move(spheres_);
  }

 private:
  // The title of the next frame may be empty; behind the last box only blank lines may follow.
  bool next_frame() {
    if (!scanner_.next_line()) return false;
    if (!trim(scanner_.line()).empty()) return true;
    TextScanner ahead(scanner_);
    return ahead.next_filled_line();
  }

  Error cut(std::int64_t frame, const std::string& expected) const {
    return scanner_.line_error("the file ends in frame " + std::to_string(frame) + ": expected " + expected);
  }

  Status read_frame(std::int64_t frame) {
    const bool wanted = frame == wanted_;
    if (wanted) read_title(scanner_.line());
    if (!scanner_.next_line()) return cut(frame, "the number of atoms");
    std::string_view field;
    scanner_.next_field(field);
    const auto count = parse_int(field);
    if (!count || *count < 0) return scanner_.field_error("expected the number of atoms but found " + quote(field));
    std::optional<std::size_t> width;
    for (std::int64_t i = 0; i < *count; ++i) {
      if (!scanner_.next_line()) return cut(frame, std::to_string(*count) + " atoms but found " + std::to_string(i));
      if (!wanted) continue;
      if (!width) width = width_of(scanner_.line());
      if (!width) return scanner_.line_error("expected coordinates with decimal points from column 21 on");
      if (Status status = read_atom(*width); !status) return status;
    }
    if (!scanner_.next_line()) return cut(frame, "the box");
    return wanted ? read_box() : Status(Done{});
  }

  // "..., t= 100.00000 step= 50000"
  void read_title(std::string_view title) {
    std::size_t end = title.size();
    const auto number_behind = [&](std::string_view key) -> std::optional<double> {
      const std::size_t at = title.rfind(key);
      if (at == std::string_view::npos || (at > 0 && title[at - 1] != ' ')) return std::nullopt;
      const std::string_view rest = trim(title.substr(at + key.size()));
      const std::optional<double> number = parse_double(rest.substr(0, rest.find(' ')));
      if (number) end = std::min(end, at);
      return number;
    };
    spheres_.time_ps = number_behind("t=");
    if (const auto step = number_behind("step="); step && *step > -9e15 && *step < 9e15)
      spheres_.step = static_cast<std::int64_t>(*step);
    // The title is the text before both.
    title = trim(title.substr(0, end));
    while (!title.empty() && (title.back() == ',' || title.back() == ';')) title.remove_suffix(1);
    spheres_.title = title_from(title);
  }

  Status read_atom(std::size_t width) {
    const std::string_view line = scanner_.line();
    std::vector<double>* const axes[3] = {&spheres_.x, &spheres_.y, &spheres_.z};
    for (std::size_t axis = 0; axis < 6; ++axis) {
      const std::size_t first = kNamesWidth + axis * width;
      const std::string_view field = first < line.size() ? trim(line.substr(first, width)) : std::string_view();
      const bool is_velocity = axis >= 3;
      if (is_velocity && field.empty()) break;
      const auto value = parse_double(field);
      const auto bad = [&](const std::string& what) {
        return scanner_.column_error(static_cast<std::int64_t>(first) + 1, what);
      };
      if (!value)
        return bad("expected a number for " + std::string(is_velocity ? "the velocity along " : "") + "xyz"[axis % 3] +
                   " in columns " + std::to_string(first + 1) + " to " + std::to_string(first + width) + " but found " +
                   quote(field));
      if (const char* fault = coordinate_fault(*value)) return bad(quote(field) + " " + fault);
      if (line.size() < first + width && scanner_.at_end() && !scanner_.ends_in_newline())
        return bad("the line ends inside a number: the file is cut");
      if (is_velocity)
        velocity_[axis - 3].values.push_back(*value);
      else
        axes[axis]->push_back(kAngstromOfNm * *value);
    }

    AtomNames names;
    names.record = "ATOM";
    names.serial = trim(line.substr(15, 5));
    names.residue_number = trim(line.substr(0, 5));
    names.residue = trim(line.substr(5, 5));
    names.name = trim(line.substr(10, 5));
    columns_.add(names, 1, 0);
    elements_.add({"", names.name, names.residue, line.substr(0, 10), scanner_.line_number()});
    return Done{};
  }

  // Three lengths, and six more numbers if the box is not a right one: v1y v1z v2x v2z v3x v3y. Large ones fill their
  // columns and leave no blank between them; all have as many decimals.
  Status read_box() {
    double v[9] = {};
    std::size_t have = 0;
    for (std::string_view field; have < 9 && scanner_.next_field(field);) {
      const std::size_t decimals = field.size() - std::min(field.size(), field.rfind('.') + 1);
      for (std::string_view left = field; !left.empty() && have < 9; ++have) {
        const std::size_t dot = left.find('.');
        const bool joined = dot != left.rfind('.');
        const std::string_view one = joined ? left.substr(0, dot + 1 + decimals) : left;
        left.remove_prefix(one.size());
        const auto value = parse_double(one);
        if (!value || coordinate_fault(*value))
          return scanner_.field_error("expected three or nine numbers of the box but found " + quote(field));
        v[have] = kAngstromOfNm * *value;
      }
    }
    if (have != 3 && have != 9)
      return scanner_.line_error("expected three or nine numbers of the box but found " + std::to_string(have));
    if (v[0] == 0 && v[1] == 0 && v[2] == 0) return Done{};
    Cell cell;
    cell.vectors = {Vec3d{v[0], v[3], v[4]}, Vec3d{v[5], v[1], v[6]}, Vec3d{v[7], v[8], v[2]}};
    spheres_.cell = cell;
    return Done{};
  }

  void finish(std::int64_t frames) {
    spheres_.frames = frames;
    spheres_.rules.push_back("coordinates: nanometres of the file, as Angstrom");
    elements_.take(spheres_, scanner_.file());
    columns_.take(spheres_.attributes);
    // The format has no chains, records, occupancies and B factors.
    SphereAttributes& attributes = spheres_.attributes;
    std::erase_if(attributes.numbers,
                  [](const NamedNumbers& one) { return one.name == "occupancy" || one.name == "b_factor"; });
    std::erase_if(attributes.texts, [](const NamedTexts& one) { return one.name == "record" || one.name == "chain"; });
    for (NamedNumbers& column : velocity_)
      if (column.values.size() == spheres_.size() && !column.values.empty())
        attributes.numbers.push_back(std::move(column));
  }

  TextScanner scanner_;
  FramePass pass_;
  std::int64_t wanted_;
  RawSpheres spheres_;
  AtomColumns columns_;
  PdbElements elements_{false};
  NamedNumbers velocity_[3] = {{"vx", {}}, {"vy", {}}, {"vz", {}}};
};

bool is_gro_atom(std::string_view line) {
  if (line.size() < kNamesWidth + 15 || !parse_int(trim(line.substr(15, 5)))) return false;
  const std::string_view number = trim(line.substr(0, 5));
  const std::optional<std::size_t> width = width_of(line);
  if (!parse_int(number) || !width || kNamesWidth + 3 * *width > line.size()) return false;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!parse_double(trim(line.substr(kNamesWidth + axis * *width, *width)))) return false;
  return true;
}

// A title, which may be empty, a count, and an atom in columns of five.
bool is_gro(const FileHead& head) {
  TextScanner scanner(head.bytes, "");
  std::string_view field;
  if (!scanner.next_line() || !scanner.next_line() || !scanner.next_field(field) || !parse_int(field)) return false;
  return !scanner.next_field(field) && scanner.next_line() && is_gro_atom(scanner.line());
}

Result<RawSpheres> read_gro(const TextScanner& scanner, const FramePass& pass) {
  return GroReader(scanner, pass).read();
}

}  // namespace

extern constexpr Format kGro(
    "GRO", ".gro", Format::kText | Format::kFrames, is_gro, read_gro,
    "a count alone on the second line, then an atom | one frame, nanometres as Ångström | van der Waals, by element",
    4);

}  // namespace bihive
