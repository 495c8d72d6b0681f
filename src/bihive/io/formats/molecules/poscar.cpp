// Structures and trajectories of VASP [VASP-POSCAR]: a comment, a factor, three vectors, names, counts, then places as
// shares of the vectors or in Angstrom. XDATCAR has one such head, or one for each frame, and "Direct configuration="
// before the places of each frame.
#include <algorithm>
#include <cmath>

#include "bihive/base/parse_number.h"
#include "bihive/io/elements.h"
#include "bihive/io/formats/format.h"
#include "bihive/io/text/fields.h"
#include "bihive/io/text/title.h"

namespace bihive {
namespace {

constexpr std::int64_t kMostAtoms = std::int64_t{1} << 40;

struct Species {
  std::string name;  // empty: not stated
  std::int64_t count = 0;
};

// The words up to a comment.
std::vector<std::string> words_on(TextScanner scanner) {
  scanner.restart_line();
  std::vector<std::string> words;
  for (std::string_view word; words.size() < 10000 && scanner.next_field(word);) {
    if (word[0] == '!' || word[0] == '#') break;
    words.emplace_back(word);
  }
  return words;
}

bool is_number(const std::string& word) {
  return parse_double(word).has_value();
}

// POTCAR's names may have a kind behind them (Fe_pv, Si/1a2b).
std::string without_kind(const std::string& name) {
  return name.substr(0, name.find_first_of("_/"));
}

bool all_are_elements(const std::vector<std::string>& words) {
  return std::all_of(words.begin(), words.end(),
                     [](const std::string& name) { return atomic_number(without_kind(name)) > 0; });
}

bool is_configuration(std::string_view line) {
  return lower_case(trim(line)).rfind("direct configuration", 0) == 0;
}

// By Newton's method, so that every machine gets the same bits. 0 for what has no finite positive root.
double cube_root(double value) {
  if (!(value > 0) || !std::isfinite(value)) return 0;
  double root = std::ldexp(1, std::ilogb(value) / 3);
  for (int i = 0; i < 100; ++i) {
    const double next = (2 * root + value / (root * root)) / 3;
    if (next == root) break;
    root = next;
  }
  return root;
}

class VaspReader {
 public:
  VaspReader(std::string_view text, const std::string& file, std::int64_t wanted)
      : scanner_(text, file), wanted_(wanted) {}

  Result<RawSpheres> read_structure() {
    spheres_.format = "POSCAR";
    if (!scanner_.next_line()) return cut("a comment");
    if (Status head = read_head(); !head) return head.error();
    if (wanted_ != 0) return no_such_frame(scanner_.file(), wanted_, 1);

    // Selective dynamics, then the kind of the coordinates; their first letters count.
    if (!scanner_.next_line()) return cut("'Direct' or 'Cartesian'");
    char kind = first_letter();
    if (kind == 's') {
      if (!scanner_.next_line()) return cut("'Direct' or 'Cartesian'");
      kind = first_letter();
    }
    const bool cartesian = kind == 'c' || kind == 'k';
    if (!cartesian && kind != 'd')
      return scanner_.line_error("expected 'Direct' or 'Cartesian' but found " + quote(trim(scanner_.line())));
    if (Status status = read_places(cartesian); !status) return status.error();
    spheres_.rules.push_back(cartesian ? "coordinates: Cartesian" : "coordinates: direct, as shares of the cell");
    finish();
    return std::move(spheres_);
  }

  Result<RawSpheres> read_trajectory() {
    spheres_.format = "XDATCAR";
    std::int64_t frames = 0;
    bool has_head = false;
    while (scanner_.next_line()) {
      if (!is_configuration(scanner_.line())) {
        // Behind the last frame only blank lines may follow; else a head of its own begins the next frame.
        if (has_head && trim(scanner_.line()).empty()) {
          TextScanner ahead(scanner_);
          if (!ahead.next_filled_line()) break;
          if (is_configuration(ahead.line())) continue;
        }
        if (Status head = read_head(); !head) return head.error();
        has_head = true;
        if (!scanner_.next_filled_line() || !is_configuration(scanner_.line()))
          return scanner_.line_error("expected 'Direct configuration=' but found " + quote(trim(scanner_.line())));
      }
      if (!has_head) return scanner_.line_error("expected the vectors of the cell before the first frame");
      const bool wanted = frames == wanted_;
      if (wanted) {
        const std::string_view line = scanner_.line();
        const std::size_t sign = line.find('=');
        if (sign != std::string_view::npos) spheres_.step = parse_int(trim(line.substr(sign + 1)));
        if (Status status = read_places(false); !status) return status.error();
        finish();
      } else {
        for (std::int64_t i = 0; i < atoms_; ++i)
          if (!scanner_.next_line()) return cut_atoms(i);
      }
      ++frames;
    }
    if (wanted_ < 0 || wanted_ >= frames) return no_such_frame(scanner_.file(), wanted_, frames);
    spheres_.frames = frames;
    return std::move(spheres_);
  }

 private:
  Error cut(const std::string& expected) const {
    return scanner_.line_error("the file ends too early: expected " + expected);
  }
  Error cut_atoms(std::int64_t found) const {
    return cut(std::to_string(atoms_) + " atoms (line " + std::to_string(count_line_) + ") but found " +
               std::to_string(found));
  }
  char first_letter() const {
    const std::string_view line = trim(scanner_.line());
    return line.empty() ? '\0' : lower_case(line.substr(0, 1))[0];
  }

  // From the comment, which is the present line, to the counts.
  Status read_head() {
    const std::vector<std::string> comment = words_on(scanner_);
    // Elements alone are no title.
    title_ = all_are_elements(comment) ? std::string() : title_from(scanner_.line());
    if (!scanner_.next_line()) return cut("a factor");
    const std::size_t factors = words_on(scanner_).size();
    Vec3d factor;
    for (int axis = 0; axis < 3; ++axis) {
      if (axis > 0 && factors != 3) {
        factor[axis] = factor[0];
        continue;
      }
      const Result<double> number = take_number(scanner_, "the factor");
      if (!number) return number.error();
      factor[axis] = *number;
    }
    const std::int64_t factor_line = scanner_.line_number();
    Cell cell;
    for (Vec3d& vector : cell.vectors) {
      if (!scanner_.next_line()) return cut("three vectors");
      const Result<Vec3d> read = take_place(scanner_);
      if (!read) return read.error();
      vector = *read;
    }
    // One negative factor is the volume; three are for x, y and z.
    if (factors != 3 && factor[0] < 0) {
      const double volume = std::abs(dot(cell.vectors[0], cross(cell.vectors[1], cell.vectors[2])));
      const double scale = cube_root(-factor[0] / volume);
      factor = {scale, scale, scale};
    }
    for (int axis = 0; axis < 3; ++axis)
      if (!(factor[axis] > 0) || !std::isfinite(factor[axis]))
        return Error{"the factor must be positive, or the negative volume of a cell that has one", scanner_.file(),
                     factor_line, 0, ""};
    factor_ = factor;
    for (Vec3d& vector : cell.vectors) vector = scaled(vector);
    cell_ = cell;
    return read_species(comment);
  }

  Vec3d scaled(Vec3d v) const { return {v.x * factor_.x, v.y * factor_.y, v.z * factor_.z}; }

  Status read_species(const std::vector<std::string>& comment) {
    if (!scanner_.next_line()) return cut("names or counts");
    std::vector<std::string> names = words_on(scanner_);
    names_from_comment_ = false;
    if (!names.empty() && is_number(names[0])) {
      // Old files have no names; their comment often has them.
      const std::size_t counts = names.size();
      names = comment;
      names_from_comment_ = comment.size() == counts && all_are_elements(comment);
      if (!names_from_comment_) names.assign(counts, "");
    } else if (!scanner_.next_line()) {
      return cut("the number of atoms of each name");
    }
    count_line_ = scanner_.line_number();
    scanner_.restart_line();
    species_.clear();
    atoms_ = 0;
    for (const std::string& name : names) {
      const Result<std::int64_t> count = take_count(scanner_, "the number of atoms of " + quote(name));
      if (!count) return count.error();
      if (*count > kMostAtoms || (atoms_ += *count) > kMostAtoms)
        return scanner_.field_error("there are more than 2^40 atoms");
      species_.push_back({name, *count});
    }
    std::string_view more;
    if (species_.empty() || (scanner_.next_field(more) && more[0] != '!' && more[0] != '#'))
      return scanner_.field_error("expected a count for each of " + std::to_string(species_.size()) +
                                  " names but found " + (species_.empty() ? "no name" : "one more: " + quote(more)));
    return Done{};
  }

  Status read_places(bool cartesian) {
    const auto room = static_cast<std::size_t>(std::min(atoms_, scanner_.bytes_left() / 6 + 1));
    for (auto* axis : {&spheres_.x, &spheres_.y, &spheres_.z}) axis->reserve(room);
    for (std::int64_t i = 0; i < atoms_; ++i) {
      if (!scanner_.next_line()) return cut_atoms(i);
      const Result<Vec3d> read = take_place(scanner_);
      if (!read) return read.error();
      const auto& [a, b, c] = cell_.vectors;
      const Vec3d at = cartesian ? scaled(*read) : read->x * a + read->y * b + read->z * c;
      for (int axis = 0; axis < 3; ++axis)
        if (const char* fault = coordinate_fault(at[axis]))
          return scanner_.line_error(std::string(1, "xyz"[axis]) + " " + fault);
      spheres_.x.push_back(at.x);
      spheres_.y.push_back(at.y);
      spheres_.z.push_back(at.z);
    }
    return Done{};
  }

  // Names that are elements become elements; if some are not, all become types.
  void finish() {
    spheres_.cell = cell_;
    spheres_.title = title_;
    bool all_known = true, any_known = false;
    std::string names;
    for (const Species& one : species_) {
      const bool known = atomic_number(without_kind(one.name)) > 0;
      all_known = all_known && known;
      any_known = any_known || known;
      names += " " + one.name;
    }
    SphereAttributes& attributes = spheres_.attributes;
    TextCollector labels;
    const bool named = !species_.empty() && !species_[0].name.empty();
    for (std::size_t kind = 0; kind < species_.size(); ++kind) {
      const auto count = static_cast<std::size_t>(species_[kind].count);
      const int element = atomic_number(without_kind(species_[kind].name));
      if (any_known) attributes.element.insert(attributes.element.end(), count, static_cast<std::uint8_t>(element));
      if (all_known) continue;
      attributes.type.insert(attributes.type.end(), count, static_cast<std::int32_t>(kind + 1));
      if (named)
        for (std::size_t i = 0; i < count; ++i) labels.add(species_[kind].name);
    }
    if (!all_known && named) attributes.texts.push_back(printable_texts(labels.take("type")));
    spheres_.rules.push_back(!named                ? "types: in the order of the counts, as the file names none"
                             : names_from_comment_ ? "elements: from the first line:" + printable(names)
                                                   : "names:" + printable(names));
  }

  TextScanner scanner_;
  std::int64_t wanted_;
  RawSpheres spheres_;
  Vec3d factor_;
  Cell cell_;
  std::string title_;
  std::vector<Species> species_;
  bool names_from_comment_ = false;
  std::int64_t atoms_ = 0, count_line_ = 0;
};

// A comment, a factor, three vectors, and names or counts.
bool begins_as_vasp(TextScanner& scanner) {
  const auto numbers = [&scanner](std::size_t least, std::size_t most) {
    const std::vector<std::string> words = words_on(scanner);
    std::size_t count = 0;
    while (count < words.size() && is_number(words[count])) ++count;
    return count >= least && count <= most && count == words.size();
  };
  if (!scanner.next_line() || !scanner.next_line() || !(numbers(1, 1) || numbers(3, 3))) return false;
  for (int vector = 0; vector < 3; ++vector)
    if (!scanner.next_line() || !numbers(3, 3)) return false;
  if (!scanner.next_line() || trim(scanner.line()).empty()) return false;
  // Counts alone, or names and then counts. A line with a comment alone has neither.
  std::vector<std::string> words = words_on(scanner);
  if (!words.empty() && !is_number(words[0])) {
    if (!scanner.next_line()) return false;
    words = words_on(scanner);
  }
  return !words.empty() && parse_int(words[0]).has_value();
}

bool is_poscar(const FileHead& head) {
  TextScanner scanner(head.bytes, "");
  if (!begins_as_vasp(scanner) || !scanner.next_line()) return false;
  const std::string_view line = trim(scanner.line());
  return !line.empty() && std::string_view("sdck").find(lower_case(line.substr(0, 1))) != std::string_view::npos &&
         !is_configuration(line);
}

bool is_xdatcar(const FileHead& head) {
  TextScanner scanner(head.bytes, "");
  return begins_as_vasp(scanner) && scanner.next_filled_line() && is_configuration(scanner.line());
}

Result<RawSpheres> read_poscar(std::string_view text, const std::string& file, std::int64_t frame) {
  return VaspReader(text, file, frame).read_structure();
}

Result<RawSpheres> read_xdatcar(std::string_view text, const std::string& file, std::int64_t frame) {
  return VaspReader(text, file, frame).read_trajectory();
}

}  // namespace

extern constexpr Format kPoscar(
    "POSCAR", ".poscar .vasp poscar* contcar*", Format::kText, is_poscar, read_poscar,
    "three vectors, counts, then the kind of the coordinates | one structure | van der Waals, by element");

extern constexpr Format kXdatcar(
    "XDATCAR", "xdatcar*", Format::kText | Format::kFrames, is_xdatcar, read_xdatcar,
    "three vectors, counts, then `Direct configuration=` | one frame | van der Waals, by element");

}  // namespace bihive
