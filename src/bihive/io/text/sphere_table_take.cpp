// The last step of a table: from columns of numbers and labels to spheres.
#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "bihive/base/parse_number.h"
#include "bihive/image/transfer.h"
#include "bihive/io/elements.h"
#include "bihive/io/text/sphere_table.h"

namespace bihive {
namespace {

// The atomic number of a label, which is an element's symbol or the number itself.
int atomic_number_of_label(const std::string& label) {
  if (const int number = atomic_number(label)) return number;
  const auto number = parse_int(label);
  return number && *number >= 1 && *number <= 118 ? static_cast<int>(*number) : 0;
}

std::optional<std::int32_t> small_int(const std::string& label) {
  const auto number = parse_int(label);
  using Limits = std::numeric_limits<std::int32_t>;
  if (!number || *number < Limits::min() || *number > Limits::max()) return std::nullopt;
  return static_cast<std::int32_t>(*number);
}

}  // namespace

const SphereTable::Column* SphereTable::find(ColumnRole role) const {
  for (const Column& column : columns_)
    if (column.role == role) return &column;
  return nullptr;
}

SphereTable::Column* SphereTable::find(ColumnRole role) {
  return const_cast<Column*>(std::as_const(*this).find(role));
}

std::vector<double> SphereTable::take_values(ColumnRole role) {
  Column* const column = find(role);
  return column ? std::move(column->values) : std::vector<double>();
}

IdOrder SphereTable::sort_by_id() {
  const auto ids = std::find_if(columns_.begin(), columns_.end(), [](const Column& column) {
    return column.role == ColumnRole::number && !column.is_text && lower_case(column.name) == "id";
  });
  if (ids == columns_.end()) return {};
  IdOrder order = order_of_ids(ids->values);
  if (order.kind != RowIds::sorted) return order;
  for (Column& column : columns_) {
    if (!column.values.empty()) put_in_order(column.values, order.rows);
    if (!column.labels.texts().empty()) put_in_order(column.labels, order.rows);
  }
  return order;
}

RawSpheres SphereTable::take() && {
  RawSpheres spheres;
  spheres.x = take_values(ColumnRole::x);
  spheres.y = take_values(ColumnRole::y);
  spheres.z = take_values(ColumnRole::z);
  take_radii(spheres);
  take_elements(spheres);
  take_colours(spheres);
  for (const double opacity : take_values(ColumnRole::opacity))
    spheres.attributes.opacity.push_back(static_cast<float>(opacity));
  for (const double transparency : take_values(ColumnRole::transparency))
    spheres.attributes.opacity.push_back(static_cast<float>(1 - transparency));
  if (!no_opacity_.empty()) spheres.rules.push_back(no_opacity_);
  take_columns(spheres);
  return spheres;
}

void SphereTable::take_radii(RawSpheres& spheres) {
  if (find(ColumnRole::radius)) {
    spheres.r = take_values(ColumnRole::radius);
    spheres.rules.push_back("radii: the column '" + find(ColumnRole::radius)->name + "'");
  } else if (find(ColumnRole::diameter)) {
    spheres.r = take_values(ColumnRole::diameter);
    for (double& r : spheres.r) r *= 0.5;
    spheres.rules.push_back("radii: half of the column '" + find(ColumnRole::diameter)->name + "'");
  }
}

// Types are the numbers themselves if all labels are whole numbers, else 1, 2, ... in order of appearance; then the
// labels stay as texts.
void SphereTable::take_types(Column& column, RawSpheres& spheres) {
  const std::vector<std::string>& labels = column.labels.texts();
  std::vector<std::int32_t> type_of_label;
  for (const std::string& label : labels)
    if (const auto number = small_int(label)) type_of_label.push_back(*number);
  const bool numbered = type_of_label.size() == labels.size();
  if (!numbered) {
    type_of_label.clear();
    for (std::size_t i = 0; i < labels.size(); ++i) type_of_label.push_back(static_cast<std::int32_t>(i + 1));
  }
  std::vector<std::int32_t>& types = spheres.attributes.type;
  types.reserve(column.labels.text_of_sphere().size());
  for (const std::int32_t label : column.labels.text_of_sphere()) types.push_back(type_of_label[std::size_t(label)]);
  if (!numbered) spheres.attributes.texts.push_back(printable_texts(column.labels.take("type")));
}

void SphereTable::take_elements(RawSpheres& spheres) {
  // Elements by atomic number, then by label.
  auto& element = spheres.attributes.element;
  for (const double number : take_values(ColumnRole::atomic_number))
    element.push_back(static_cast<std::uint8_t>(number));
  Column* const species = find(ColumnRole::species);
  bool all_known = true;
  if (species) {
    std::vector<std::uint8_t> element_of_label;
    for (const std::string& label : species->labels.texts())
      element_of_label.push_back(static_cast<std::uint8_t>(atomic_number_of_label(label)));
    all_known = std::count(element_of_label.begin(), element_of_label.end(), 0) == 0;
    if (element.empty())
      for (const std::int32_t label : species->labels.text_of_sphere())
        element.push_back(element_of_label[std::size_t(label)]);
  }
  if (std::all_of(element.begin(), element.end(), [](std::uint8_t number) { return number == 0; })) element.clear();

  // Types by their own column, else by those labels that are no elements.
  if (Column* const type = find(ColumnRole::type)) {
    take_types(*type, spheres);
  } else if (species && !all_known) {
    take_types(*species, spheres);
    spheres.rules.push_back("types: from the labels in column '" + species->name + "', as not all are elements");
  }
}

void SphereTable::take_colours(RawSpheres& spheres) {
  const std::vector<double> red = take_values(ColumnRole::red);
  const std::vector<double> green = take_values(ColumnRole::green);
  const std::vector<double> blue = take_values(ColumnRole::blue);
  if (red.empty()) return;

  // Decide whether colours range from 0 to 1 or from 0 to 255.
  double largest = 0;
  for (const auto* part : {&red, &green, &blue})
    largest = std::max(largest, *std::max_element(part->begin(), part->end()));
  const bool bytes = colours_are_bytes_ || largest > 1;
  spheres.rules.push_back(bytes ? "colours: sRGB, 0 to 255" : "colours: linear, 0 to 1");

  // Make them linear.
  const auto linear = [bytes](double part) { return static_cast<float>(bytes ? linear_from_srgb(part / 255) : part); };
  spheres.attributes.colour.reserve(red.size());
  for (std::size_t i = 0; i < red.size(); ++i)
    spheres.attributes.colour.push_back({linear(red[i]), linear(green[i]), linear(blue[i])});
}

void SphereTable::take_columns(RawSpheres& spheres) {
  std::string left_out;
  for (Column& column : columns_) {
    if (column.role != ColumnRole::number) continue;
    if (column.is_text)
      spheres.attributes.texts.push_back(printable_texts(column.labels.take(column.name)));
    else if (column.has_number)
      spheres.attributes.numbers.push_back({column.name, std::move(column.values)});
    else
      left_out += " " + column.name;
  }
  if (!left_out.empty()) spheres.rules.push_back("empty columns are left out:" + left_out);
}

}  // namespace bihive
