#include "bihive/scene/links.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "bihive/base/parse_number.h"
#include "bihive/base/setting_name.h"
#include "bihive/geometry/lattice.h"
#include "bihive/io/text/text_scanner.h"
#include "bihive/scene/pair_line.h"
#include "bihive/scene/stick_colours.h"

namespace bihive {
namespace {

constexpr double kRadiusOfLinks = 0.25;  // of the smaller sphere's
constexpr std::int64_t kMostShift = std::int64_t{1} << 40;
constexpr const char* kImages[] = {"image_a", "image_b", "image_c"};

// ---- Reading ----

bool next_row_of_links(TextScanner& scanner) {
  while (scanner.next_filled_line())
    if (trim(scanner.line()).front() != '#') return true;
  return false;
}

std::vector<std::string> fields_of_row(TextScanner& scanner) {
  std::vector<std::string> fields;
  for (std::string_view field; scanner.next_field(field);) fields.emplace_back(field);
  return fields;
}

// Which columns are what: the pair's, those of images, and all others.
struct LinkColumns {
  std::array<std::size_t, 2> pair{0, 1};
  std::optional<std::array<std::size_t, 3>> images;
  std::vector<std::size_t> numbers;
};

Result<LinkColumns> columns_of_links(const std::vector<std::string>& names, const TextScanner& scanner) {
  const auto place_of = [&](const std::string& wanted) -> std::optional<std::size_t> {
    const auto found = std::find(names.begin(), names.end(), wanted);
    if (found == names.end()) return std::nullopt;
    return static_cast<std::size_t>(found - names.begin());
  };
  if (names.size() < 2)
    return scanner.line_error("expected the names of two columns or more, found " + quote(scanner.line()),
                              "the first line names the columns: first,second,area");
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i].empty() || parse_double(names[i]))
      return scanner.line_error("expected the names of columns, found " + quote(names[i]),
                                "the first line names the columns: first,second,area");
    if (std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i), names[i]) !=
        names.begin() + static_cast<std::ptrdiff_t>(i))
      return scanner.line_error("two columns have the name " + quote(names[i]), "rename one of them");
  }
  LinkColumns columns;
  const std::optional<std::size_t> first = place_of("first"), second = place_of("second");
  if (first && second) columns.pair = {*first, *second};
  std::array<std::size_t, 3> images{};
  std::size_t known = 0;
  for (const char* const name : kImages)
    if (const std::optional<std::size_t> place = place_of(name)) images[known++] = *place;
  if (known != 0 && known != 3)
    return scanner.line_error("of image_a, image_b and image_c some are missing", "state all three, or none");
  if (known == 3) columns.images = images;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const bool is_image = known == 3 && std::find(images.begin(), images.end(), i) != images.end();
    if (i != columns.pair[0] && i != columns.pair[1] && !is_image) columns.numbers.push_back(i);
  }
  return columns;
}

Result<std::int64_t> whole_field(const TextScanner& scanner, const std::string& name, const std::string& field,
                                 std::int64_t least, std::int64_t most) {
  const std::optional<double> number = parse_double(field);
  if (!number || std::floor(*number) != *number || *number < double(least) || *number > double(most))
    return scanner.line_error(
        name + ": expected a whole number" + (least == 0 ? " from 0" : "") + ", found " + quote(field),
        least == 0 ? "spheres are counted from 0, in the order of the file" : "");
  return static_cast<std::int64_t>(*number);
}

// ---- Drawing ----

// Positions of shown spheres by their numbers in the input; kNothing: hidden.
std::vector<std::int64_t> shown_by_input(const Scene& scene) {
  const std::int64_t shown = scene.spheres.size();
  const std::int64_t count = scene.id_in_input.empty() ? shown : std::max(shown, scene.size_of_input);
  std::vector<std::int64_t> by_input(static_cast<std::size_t>(count), kNothing);
  for (std::int64_t id = 0; id < shown; ++id) by_input[static_cast<std::size_t>(input_id(scene, id))] = id;
  return by_input;
}

// The numbers of the rows as attributes of a set that stands for them.
Result<SphereSet> rows_as_spheres(const LinkTable& table) {
  const std::vector<float> zeros(table.pairs.size(), 0);
  Result<SphereSet> rows = SphereSet::from_world(zeros, zeros, zeros, zeros);
  if (!rows) return rows;
  for (const auto& [name, values] : table.columns) rows->attributes().numbers.push_back({name, values});
  return rows;
}

std::string names_of_columns(const LinkTable& table) {
  std::string names;
  for (const auto& column : table.columns) names += (names.empty() ? "" : ", ") + column.first;
  return names.empty() ? "the table has no other columns" : "there are " + names;
}

// The radius of each row; +inf: a quarter of the smaller sphere's.
Result<std::vector<double>> radii_of_links(const LinkTable& table, const std::string& text) {
  const std::string setting = "link_radius";
  const std::size_t count = table.pairs.size();
  if (text.empty()) return std::vector<double>(count, std::numeric_limits<double>::infinity());
  if (const std::optional<double> one = parse_double(text)) {
    if (!(*one > 0 && std::isfinite(*one)))
      return Error{setting_name(setting) + ": expected a number above 0, found \"" + text + "\"", "", 0, 0, ""};
    return std::vector<double>(count, *one);
  }
  const std::size_t colon = text.rfind(':');
  const std::string name = text.substr(0, colon);
  double factor = 1;
  if (colon != std::string::npos) {
    const std::optional<double> stated = parse_double(text.substr(colon + 1));
    if (!stated || !(*stated > 0 && std::isfinite(*stated)))
      return Error{setting_name(setting) + ": expected a factor above 0 after the colon, found \"" + text + "\"", "", 0,
                   0, ""};
    factor = *stated;
  }
  const auto column =
      std::find_if(table.columns.begin(), table.columns.end(), [&](const auto& one) { return one.first == name; });
  if (column == table.columns.end())
    return Error{setting_name(setting) + ": no number, and there is no column \"" + name + "\"", "", 0, 0,
                 names_of_columns(table)};
  std::vector<double> radii = column->second;
  for (std::size_t row = 0; row < count; ++row) {
    if (radii[row] < 0 || std::isinf(radii[row]))
      return Error{setting_name(setting) + ": row " + std::to_string(row) + " of " + name + " is " +
                       (radii[row] < 0 ? "below 0" : "infinite"),
                   "", 0, 0, "a radius is a finite number from 0"};
    radii[row] *= factor;
  }
  return radii;
}

}  // namespace

Result<LinkTable> links_from_csv(std::string_view text, const std::string& file) {
  TextScanner scanner(text, file);
  scanner.set_separator(',');
  if (!next_row_of_links(scanner))
    return scanner.line_error("there is no line in it", "the first line names the columns");
  scanner.set_separator(',');
  const std::vector<std::string> names = fields_of_row(scanner);
  const Result<LinkColumns> columns = columns_of_links(names, scanner);
  if (!columns) return columns.error();
  LinkTable table;
  for (const std::size_t i : columns->numbers) table.columns.emplace_back(names[i], std::vector<double>());
  while (next_row_of_links(scanner)) {
    scanner.set_separator(',');
    const std::vector<std::string> fields = fields_of_row(scanner);
    if (fields.size() != names.size())
      return scanner.line_error("expected " + std::to_string(names.size()) + " fields, found " +
                                std::to_string(fields.size()));
    std::array<std::int64_t, 2> pair{};
    for (std::size_t k = 0; k < 2; ++k) {
      const Result<std::int64_t> sphere =
          whole_field(scanner, names[columns->pair[k]], fields[columns->pair[k]], 0, kMostShift);
      if (!sphere) return sphere.error();
      pair[k] = *sphere;
    }
    table.pairs.push_back(pair);
    if (columns->images) {
      std::array<std::int64_t, 3> image{};
      for (std::size_t k = 0; k < 3; ++k) {
        const Result<std::int64_t> count =
            whole_field(scanner, kImages[k], fields[(*columns->images)[k]], -kMostShift, kMostShift);
        if (!count) return count.error();
        image[k] = *count;
      }
      table.images.push_back(image);
    }
    for (std::size_t k = 0; k < columns->numbers.size(); ++k) {
      const std::string& field = fields[columns->numbers[k]];
      const std::optional<double> number =
          field.empty() ? std::optional(std::numeric_limits<double>::quiet_NaN()) : parse_double(field);
      if (!number) return scanner.line_error(names[columns->numbers[k]] + ": expected a number, found " + quote(field));
      table.columns[k].second.push_back(*number);
    }
  }
  return table;
}

Result<AddedLinks> add_links(Scene& scene, const LinkTable& table, const Links& links) {
  SphereSet& spheres = scene.spheres;
  const auto fault = [](const std::string& message, const std::string& hint) {
    return Error{setting_name("links") + ": " + message, "", 0, 0, hint};
  };
  const Result<std::vector<double>> radii = radii_of_links(table, links.radius);
  if (!radii) return radii.error();
  std::optional<ColourBy> how;
  std::vector<Vec3f> colours;
  if (!links.colour.empty() && !table.pairs.empty()) {
    const Result<SphereSet> rows = rows_as_spheres(table);
    if (!rows) return rows.error();
    Result<std::vector<Vec3f>> made =
        stick_colours(*rows, scene, "link_colour", links.colour, std::vector<std::uint8_t>(table.pairs.size(), 1), how);
    if (!made) return made.error();
    colours = std::move(*made);
  }
  const std::optional<Lattice> lattice = Lattice::of(spheres.cell());
  const std::vector<std::int64_t> shown = shown_by_input(scene);

  AddedLinks added;
  std::vector<OwnStick> sticks;
  for (std::size_t row = 0; row < table.pairs.size(); ++row) {
    const auto [one, other] = table.pairs[row];
    const std::string of_row = "row " + std::to_string(row);
    for (const std::int64_t id : table.pairs[row])
      if (id >= static_cast<std::int64_t>(shown.size()))
        return fault(of_row + " names sphere " + std::to_string(id) + ", and there are " + std::to_string(shown.size()),
                     "spheres are counted from 0, in the order of the file");
    const std::int64_t a = shown[static_cast<std::size_t>(one)], b = shown[static_cast<std::size_t>(other)];
    ImageCounts image{};
    if (!table.images.empty()) image = table.images[row];
    if (image != ImageCounts{} && !lattice)
      return fault(of_row + " names an image, and the spheres have no periodic cell", "");
    if (one == other && image == ImageCounts{})
      return fault(of_row + " joins sphere " + std::to_string(one) + " with itself", "");
    if (a == kNothing || b == kNothing) continue;

    if (table.images.empty() && lattice)
      image = nearest_image(spheres.local_centre(a), spheres.local_centre(b), *lattice);
    double radius = (*radii)[row];
    if (std::isinf(radius)) radius = kRadiusOfLinks * std::min(spheres.radius(a), spheres.radius(b));
    if (std::isnan(radius)) ++added.unknown;
    if (!(radius > 0)) continue;
    PairLine line{static_cast<std::int32_t>(a), static_cast<std::int32_t>(b), image, radius, {}, links.dashed};
    if (!colours.empty()) line.colour = colours[row];
    add_pair_line(spheres, lattice, line, sticks);
    ++added.count;
  }
  if (Status status = scene.sticks.add(spheres, sticks); !status) return error_of_setting("links", status.error());
  if (Status status = check_sticks(scene); !status) return status.error();
  if (added.count > 0 && how) scene.sticks_coloured_by.push_back(std::move(*how));
  return added;
}

}  // namespace bihive
