#include "bihive/io/formats/molecules/lammps_styles.h"

#include <algorithm>

#include "bihive/base/parse_number.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

struct LammpsStyle {
  std::string_view name, columns;
};
constexpr LammpsStyle kStyles[] = {
    {"angle", "id mol type x y z"},
    {"atomic", "id type x y z"},
    {"body", "id type bodyflag mass x y z"},
    {"bond", "id mol type x y z"},
    {"bpm/sphere", "id mol type diameter density x y z"},
    {"charge", "id type q x y z"},
    {"dipole", "id type q x y z mux muy muz"},
    {"dpd", "id type theta x y z"},
    {"edpd", "id type edpd_temp edpd_cv x y z"},
    {"electron", "id type q espin eradius x y z"},
    {"ellipsoid", "id type ellipsoidflag density x y z"},
    {"full", "id mol type q x y z"},
    {"line", "id mol type lineflag density x y z"},
    {"mdpd", "id type rho x y z"},
    {"molecular", "id mol type x y z"},
    {"peri", "id type volume density x y z"},
    {"smd", "id type mol volume mass kradius cradius x0 y0 z0 x y z"},
    {"sph", "id type rho esph cv x y z"},
    {"sphere", "id type diameter density x y z"},
    {"spin", "id type x y z spx spy spz sp"},
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

}  // namespace

std::optional<std::vector<TableColumn>> lammps_columns(std::string_view style) {
  const std::vector<std::string> words = words_of(style);
  if (words.empty()) return std::nullopt;
  const bool hybrid = words[0] == "hybrid";
  if (!hybrid && words.size() > 1) return std::nullopt;
  // A hybrid style has what all styles share, then the columns of each that are not there yet. Where one is unknown,
  // what all share is known.
  std::vector<TableColumn> columns;
  if (hybrid) add_columns("id type x y z", columns);
  for (std::size_t i = hybrid ? 1 : 0; i < words.size(); ++i) {
    const auto found = std::find_if(std::begin(kStyles), std::end(kStyles),
                                    [&](const LammpsStyle& one) { return one.name == words[i]; });
    if (found == std::end(kStyles)) {
      if (!hybrid) return std::nullopt;
      columns.clear();
      add_columns("id type x y z", columns);
      break;
    }
    add_columns(found->columns, columns);
  }
  return columns;
}

std::string guess_lammps_style(std::string_view line, std::int64_t types) {
  const std::vector<std::string> fields = words_of(line);
  const std::size_t count = fields.size() - (ends_in_image_flags(line) ? 3 : 0);
  if (count < 5 || count > 7) return "";
  if (count == 5) return "atomic";
  // The third column is a type, or something else.
  const auto third = parse_int(fields[2]);
  const bool third_is_type = third && *third >= 1 && *third <= types && is_whole(fields[1]);
  if (count == 6) return third_is_type ? "molecular" : "charge";
  return third_is_type ? "full" : "sphere";
}

bool ends_in_image_flags(std::string_view line) {
  const std::vector<std::string> fields = words_of(line);
  return fields.size() >= 8 && std::all_of(fields.end() - 3, fields.end(), is_whole);
}

}  // namespace bihive
