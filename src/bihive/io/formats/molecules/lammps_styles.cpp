#include "bihive/io/formats/molecules/lammps_styles.h"

#include <algorithm>

#include "bihive/base/parse_number.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

// Several rows of a name: the number of columns tells. A name that ends in '*' stands for as many columns as there are.
struct LammpsStyle {
  std::string_view name, columns;
};
constexpr LammpsStyle kStyles[] = {
    {"amoeba", "id mol type q x y z"},
    {"angle", "id mol type x y z"},
    {"apip", "id type x y z"},
    {"atomic", "id type x y z"},
    {"body", "id type bodyflag mass x y z"},
    {"bond", "id mol type x y z"},
    {"bpm/sphere", "id mol type diameter density x y z"},
    {"charge", "id type q x y z"},
    // The program, and its manual.
    {"dielectric", "id mol type q x y z mux muy muz area ed em epsilon curvature"},
    {"dielectric", "id type q x y z mux muy muz area ed em epsilon curvature"},
    {"dipole", "id type q x y z mux muy muz"},
    {"dpd", "id type theta x y z"},
    {"edpd", "id type edpd_temp edpd_cv x y z"},
    {"electron", "id type q espin eradius x y z"},
    {"ellipsoid", "id type ellipsoidflag density x y z"},
    {"full", "id mol type q x y z"},
    {"line", "id mol type lineflag density x y z"},
    {"mdpd", "id type rho x y z"},
    // The program, and its manual.
    {"mesont", "id mol type bond_nt_1 bond_nt_2 mass mradius mlength buckling x y z"},
    {"mesont", "id mol type bond_nt mass mradius mlength buckling x y z"},
    {"molecular", "id mol type x y z"},
    {"oxdna", "id type x y z"},
    {"peri", "id type volume density x y z"},
    {"rheo", "id type status rho x y z"},
    {"rheo/thermal", "id type status rho esph x y z"},
    {"smd", "id type mol volume mass kradius cradius x0 y0 z0 x y z"},
    {"sph", "id type rho esph cv x y z"},
    {"sphere", "id type diameter density x y z"},
    {"spin", "id type x y z spx spy spz sp"},
    {"tdpd", "id type x y z cc*"},
    {"template", "id type mol template_index template_atom x y z"},
    {"tri", "id mol type triangleflag density x y z"},
    {"wavepacket", "id type q espin eradius etag cs_re cs_im x y z"},
};

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  TextScanner scanner(text, "");
  if (!scanner.next_line()) return words;
  for (std::string_view word; words.size() < 64 && scanner.next_field(word);) words.emplace_back(word);
  return words;
}

void add_columns(std::string_view names, std::vector<TableColumn>& columns) {
  for (const std::string& name : words_of(names)) {
    const bool known = std::any_of(columns.begin(), columns.end(), [&](const auto& one) { return one.name == name; });
    if (!known) columns.push_back({name, usual_role(name)});
  }
}

bool is_whole(std::string_view field) {
  return parse_int(field).has_value();
}

// Image flags are three more.
std::int64_t columns_without_flags(const LammpsAtomLines& lines) {
  return lines.fields - (lines.ends_in_flags ? 3 : 0);
}

// The words of a stated style, in lower case and without what names a variant for accelerators.
std::vector<std::string> style_words(std::string_view style) {
  std::vector<std::string> words = words_of(lower_case(style));
  for (std::string& word : words)
    if (word.ends_with("/kk")) word.resize(word.size() - 3);
  return words;
}

// Adds the columns of one style that are not there yet; false if they are not known. `lines`: null in a hybrid style,
// whose lines have the columns of others too.
bool add_style(const std::string& name, const LammpsAtomLines* lines, std::vector<TableColumn>& columns) {
  const LammpsStyle* chosen = nullptr;
  for (const LammpsStyle& one : kStyles) {
    if (one.name != name) continue;
    const auto own = static_cast<std::int64_t>(words_of(one.columns).size());
    const bool fits = lines != nullptr && (own == lines->fields || (lines->ends_in_flags && own + 3 == lines->fields));
    if (chosen == nullptr || fits) chosen = &one;
  }
  if (chosen == nullptr) return false;
  const bool is_open = chosen->columns.ends_with('*');
  if (!is_open || lines == nullptr) {
    if (!is_open) add_columns(chosen->columns, columns);
    return !is_open;
  }
  const std::size_t tail = chosen->columns.rfind(' ');
  add_columns(chosen->columns.substr(0, tail), columns);
  const std::string counted(chosen->columns.substr(tail + 1, chosen->columns.size() - tail - 2));
  for (int i = 1; static_cast<std::int64_t>(columns.size()) < columns_without_flags(*lines) &&
                  columns.size() <= SphereTable::kMostColumns;
       ++i)
    columns.push_back({counted + std::to_string(i), ColumnRole::number});
  return true;
}

}  // namespace

LammpsAtomLines look_at_atom_lines(TextScanner scanner, std::int64_t most,
                                   const std::function<bool(std::string_view)>& is_type) {
  LammpsAtomLines lines;
  for (std::int64_t i = 0; i < most; ++i) {
    if (i > 0 && !scanner.next_filled_line()) break;
    const std::vector<std::string> fields = words_of(scanner.line());
    const bool ends_in_flags = fields.size() >= 8 && std::all_of(fields.end() - 3, fields.end(), is_whole);
    if (i == 0) {
      lines.fields = static_cast<std::int64_t>(fields.size());
      lines.ends_in_flags = ends_in_flags;
    }
    lines.ends_in_flags = lines.ends_in_flags && ends_in_flags;
    lines.third_is_type = lines.third_is_type && fields.size() > 2 && is_whole(fields[1]) && is_type(fields[2]);
  }
  return lines;
}

std::optional<std::vector<TableColumn>> lammps_columns(std::string_view style, const LammpsAtomLines& lines) {
  const std::vector<std::string> words = style_words(style);
  if (words.empty()) return std::nullopt;
  std::vector<TableColumn> columns;
  if (words[0] != "hybrid") return add_style(words[0], &lines, columns) ? std::optional(columns) : std::nullopt;
  // A hybrid style has what all styles share, then the columns of each that are not there yet. Where one is unknown,
  // what all share is known.
  add_columns("id type x y z", columns);
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (add_style(words[i], nullptr, columns)) continue;
    columns.clear();
    add_columns("id type x y z", columns);
    break;
  }
  return columns;
}

bool needs_all_lines(std::string_view style) {
  const std::vector<std::string> words = style_words(style);
  if (words.empty() || words[0] == "hybrid") return true;
  std::int64_t rows = 0;
  bool is_open = false;
  for (const LammpsStyle& one : kStyles) {
    if (one.name != words[0]) continue;
    ++rows;
    is_open = is_open || one.columns.ends_with('*');
  }
  return rows > 1 || is_open;
}

std::string lammps_style_names() {
  std::string names;
  std::string_view last;
  for (const LammpsStyle& one : kStyles)
    if (one.name != last) names += (names.empty() ? "" : ", ") + std::string(last = one.name);
  return names + ", hybrid";
}

std::string guess_lammps_style(const LammpsAtomLines& lines) {
  // The third column is a type, or something else.
  switch (columns_without_flags(lines)) {
    case 5:
      return "atomic";
    case 6:
      return lines.third_is_type ? "molecular" : "charge";
    case 7:
      return lines.third_is_type ? "full" : "sphere";
    default:
      return "";
  }
}

}  // namespace bihive
