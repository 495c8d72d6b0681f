#include "spheres.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <string_view>
#include <utility>

#include "arrays.h"
#include "bihive/base/memory.h"
#include "bihive/base/readable.h"
#include "bihive/base/timer.h"
#include "bihive/base/watch.h"
#include "bihive/base/write_file.h"
#include "bihive/bih/reference_builder.h"
#include "bihive/geometry/lattice.h"
#include "bihive/geometry/measures.h"
#include "bihive/geometry/rounding_loss.h"
#include "bihive/image/colour_text.h"
#include "bihive/image/transfer.h"
#include "bihive/io/bonds.h"
#include "bihive/io/bundled.h"
#include "bihive/io/elements.h"
#include "bihive/io/packed.h"
#include "bihive/io/reading_settings.h"
#include "bihive/io/text/title.h"
#include "bihive/io/write_spheres.h"
#include "bihive/job/input.h"
#include "bihive/job/scene_request.h"
#include "bihive/job/selection.h"
#include "bihive/render/memory.h"
#include "bihive/scene/colour_by.h"
#include "bihive/scene/load_scene.h"
#include "bihive/scene/look_text.h"
#include "bihive/select/selection.h"
#include "bihive/viewer/statistics_json.h"
#include "errors.h"
#include "waiting.h"

namespace py = pybind11;

namespace bihive::python {
namespace {

NamedTexts texts_from(const std::string& name, const std::vector<std::string>& values) {
  TextCollector texts;
  texts.reserve(values.size());
  for (const std::string& value : values) texts.add(value);
  return texts.take(name);
}

std::vector<Vec3f> colours_from(const Array<float>& array) {
  std::vector<Vec3f> colours(static_cast<std::size_t>(array.shape(0)));
  for (std::size_t i = 0; i < colours.size(); ++i)
    for (int k = 0; k < 3; ++k) colours[i][k] = array.at(static_cast<py::ssize_t>(i), k);
  return colours;
}

[[noreturn]] void fail_size(const std::string& name) {
  fail_usage(name + ": its shape is not that of the spheres");
}

// `columns`: 0 for an array of one axis.
void check_size(const std::string& name, const py::array& array, py::ssize_t count, py::ssize_t columns = 0) {
  const bool fits = columns == 0 ? array.ndim() == 1 : array.ndim() == 2 && array.shape(1) == columns;
  if (!fits || array.shape(0) != count) fail_size(name);
}

using NumberColumns = std::vector<std::pair<std::string, Array<double>>>;
using TextColumns = std::vector<std::pair<std::string, std::vector<std::string>>>;

// Rounds the numbers of arrays once; a doubt about that becomes a warning.
void take_places(SphereFile& file, const py::array& xyz, const py::array& radius) {
  const NumbersView x = column_of(xyz, 0), y = column_of(xyz, 1), z = column_of(xyz, 2), r = view_of(radius);
  const py::gil_scoped_release unlocked;
  file.spheres = value_of(SphereSet::from_world(x, y, z, r, SphereSet::Origin::fitting));
  std::string warning = rounding_warning(rounding_loss(file.spheres, x, y, z, r), file.spheres.size());
  if (!warning.empty()) file.warnings.push_back(std::move(warning));
}

// Arrays have an entry for each sphere, and types as bihive/_spheres.py gives them.
SharedSpheres spheres_from_arrays(
    const py::array& xyz, const py::array& radius, const std::optional<Array<std::uint8_t>>& element,
    const std::optional<Array<std::int32_t>>& type, const std::optional<Array<float>>& colour,
    const std::optional<Array<float>>& opacity, const NumberColumns& numbers, const TextColumns& texts,
    const std::optional<Array<double>>& cell, const std::array<bool, 3>& periodic, const std::string& format,
    const std::string& name, std::int64_t frames, std::optional<double> time_ps, std::optional<std::int64_t> step,
    const std::vector<std::string>& rules, const std::string& title, const std::string& entry_id) {
  const py::ssize_t count = xyz.ndim() == 2 && xyz.shape(1) >= 3 ? xyz.shape(0) : -1;
  check_size("radius", radius, count);
  if (element) check_size("element", *element, count);
  if (type) check_size("type", *type, count);
  if (opacity) check_size("opacity", *opacity, count);
  if (colour) check_size("colour", *colour, count, 3);
  for (const auto& [column, values] : numbers) check_size(column, values, count);
  for (const auto& [column, values] : texts)
    if (static_cast<py::ssize_t>(values.size()) != count) fail_size(column);
  if (cell) check_size("cell", *cell, 4, 3);
  auto made = std::make_shared<Spheres>();
  take_places(made->file, xyz, radius);
  SphereAttributes& attributes = made->file.spheres.attributes();
  if (element) attributes.element = vector_from<std::uint8_t>(*element);
  if (type) attributes.type = vector_from<std::int32_t>(*type);
  if (colour) attributes.colour = colours_from(*colour);
  if (opacity) attributes.opacity = vector_from<float>(*opacity);
  for (const auto& [column, values] : numbers) attributes.numbers.push_back({column, vector_from<double>(values)});
  for (const auto& [column, values] : texts) attributes.texts.push_back(texts_from(column, values));
  if (cell) {
    const auto row = [&](py::ssize_t i) { return Vec3d{cell->at(i, 0), cell->at(i, 1), cell->at(i, 2)}; };
    const Cell stated{row(3), {row(0), row(1), row(2)}, periodic};
    made->file.spheres.cell() = stated;
    if (std::string why = Lattice::why_none(stated); !why.empty()) made->file.warnings.push_back(std::move(why));
  }
  made->file.format = format;
  made->file.frames = frames;
  made->file.time_ps = time_ps;
  made->file.step = step;
  made->file.rules = rules;
  made->file.title = title_from(title);
  made->file.entry_id = entry_id_from(entry_id);
  made->name = name;
  return made;
}

// A set without spheres, with the metadata of the whole: format, frames, time, step, rules and name.
std::shared_ptr<Spheres> facts_of(const Spheres& whole) {
  auto made = std::make_shared<Spheres>();
  SphereFile& file = made->file;
  file.format = whole.file.format;
  file.title = whole.file.title;
  file.entry_id = whole.file.entry_id;
  file.frames = whole.file.frames;
  file.rules = whole.file.rules;
  file.assemblies = whole.file.assemblies;
  file.time_ps = whole.file.time_ps;
  file.step = whole.file.step;
  file.recentred_by = whole.file.recentred_by;
  made->name = whole.name;
  return made;
}

// The spheres of these ids, which are in range, with their attributes. They are rounded again, as those of arrays are:
// relative to an origin of their own.
SphereSet rounded_again(const SphereSet& set, std::vector<std::int64_t> ids) {
  std::array<std::vector<double>, 4> columns;
  for (std::vector<double>& column : columns) column.reserve(ids.size());
  for (std::int64_t& id : ids) {
    const Vec3d centre = set.centre(id);
    for (std::size_t axis = 0; axis < 3; ++axis) columns[axis].push_back(centre[static_cast<int>(axis)]);
    columns[3].push_back(set.radius(id));
    id = set.stored_id(id);
  }
  const auto view = [&](std::size_t column) { return NumbersView::of(columns[column]); };
  SphereSet made = value_of(SphereSet::from_world(view(0), view(1), view(2), view(3), SphereSet::Origin::fitting));
  made.attributes() = set.attributes().part(ids);
  return made;
}

// The same with all that is known of the whole.
SharedSpheres part_of(const Spheres& whole, const Array<std::int64_t>& positions) {
  std::vector<std::int64_t> ids = vector_from<std::int64_t>(positions);
  const py::gil_scoped_release unlocked;
  const std::shared_ptr<Spheres> made = facts_of(whole);
  made->file.spheres = rounded_again(whole.file.spheres, std::move(ids));
  made->file.spheres.cell() = whole.file.spheres.cell();
  return made;
}

// The same spheres in other places. bihive/_spheres.py has checked the shapes.
SharedSpheres moved(const Spheres& whole, const py::array& xyz, const py::array& radius) {
  const std::shared_ptr<Spheres> made = facts_of(whole);
  take_places(made->file, xyz, radius);
  made->file.spheres.attributes() = whole.file.spheres.attributes();
  made->file.spheres.cell() = whole.file.spheres.cell();
  return made;
}

// The same spheres with these columns instead of those of the same names and of those in `without`.
SharedSpheres with_columns(const Spheres& whole, const NumberColumns& numbers, const TextColumns& texts,
                           const std::vector<std::string>& without) {
  auto made = std::make_shared<Spheres>(whole);
  SphereAttributes& attributes = made->file.spheres.attributes();
  const auto remove = [&](const std::string& name) {
    const auto has_name = [&](const auto& column) { return column.name == name; };
    auto& known_numbers = attributes.numbers;
    auto& known_texts = attributes.texts;
    known_numbers.erase(std::remove_if(known_numbers.begin(), known_numbers.end(), has_name), known_numbers.end());
    known_texts.erase(std::remove_if(known_texts.begin(), known_texts.end(), has_name), known_texts.end());
  };
  for (const std::string& name : without) remove(name);
  for (const auto& [name, values] : numbers) {
    remove(name);
    attributes.numbers.push_back({name, vector_from<double>(values)});
  }
  for (const auto& [name, values] : texts) {
    remove(name);
    attributes.texts.push_back(texts_from(name, values));
  }
  return made;
}

// The same spheres with these bonds: rows of two ids, the smaller one first, and an order. bihive/_spheres.py has
// checked them.
SharedSpheres with_bonds(const Spheres& whole, const Array<std::int32_t>& rows, bool are_all) {
  auto made = std::make_shared<Spheres>(whole);
  StatedBonds& bonds = made->file.spheres.attributes().bonds;
  bonds = {};
  for (py::ssize_t i = 0; i < rows.shape(0); ++i)
    bonds.add(rows.at(i, 0), rows.at(i, 1), static_cast<BondOrder>(rows.at(i, 2)));
  bonds.put_in_order();
  bonds.are_all = are_all;
  return made;
}

py::array_t<std::int32_t> bonds_of(const Spheres& spheres) {
  std::vector<std::int32_t> rows;
  for (const StatedBond& bond : spheres.file.spheres.attributes().bonds.list)
    for (const std::int32_t number : {bond.one, bond.other, static_cast<std::int32_t>(bond.order)})
      rows.push_back(number);
  const auto count = static_cast<py::ssize_t>(rows.size() / 3);
  return array_from<std::int32_t>(rows, {count, 3});
}

SphereFile without_scene(LoadedScene loaded) {
  SphereFile file;
  file.spheres = std::move(loaded.scene.spheres);
  file.format = loaded.format;
  file.title = std::move(loaded.title);
  file.entry_id = std::move(loaded.entry_id);
  file.frames = loaded.frames;
  file.rules = std::move(loaded.rules);
  file.warnings = std::move(loaded.warnings);
  file.assemblies = std::move(loaded.assemblies);
  file.time_ps = loaded.time_ps;
  file.step = loaded.step;
  file.assumed_radii = loaded.has_assumed_radii;
  file.recentred_by = loaded.recentred_by;
  return file;
}

SphereFile read_input_file(const InputOptions& options) {
  if (std::optional<Input> generated = generated_input(options)) return without_scene(std::move(*generated));
  check_input_options(options);
  const ReadOptions& reading = options.reading.options();
  if (options.input == "demo") return value_of(read_spheres_from_memory(bundled_molecule(), "demo", reading));
  if (!must_be_read_whole(options.input)) return value_of(read_spheres(options.input, reading));
  const std::string bytes = value_of(unpack_if_packed(read_input(options.input), options.input));
  if (!looks_like_scene(bytes)) return value_of(read_spheres_from_memory(bytes, options.input, reading));
  return without_scene(value_of(load_scene(bytes, options.input, reading)));
}

// A bond through a side of the cell goes to the next copy, and from the last one to the first.
std::vector<StatedBond> bonds_of_copies(const SphereSet& set) {
  const std::vector<ImagePair> pairs = bonds_of_file(set);
  const Images& images = set.images();
  StatedBonds made;
  if (set.total_size() > std::numeric_limits<std::int32_t>::max()) return made.list;
  for (std::int64_t copy = 0; copy < images.count(); ++copy) {
    const std::array<std::int32_t, 3> place = images.place(copy);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      std::array<std::int32_t, 3> other{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int64_t count = images.counts[axis];
        other[axis] = static_cast<std::int32_t>(((place[axis] + pairs[k].image[axis]) % count + count) % count);
      }
      made.add(static_cast<std::int32_t>(pairs[k].pair[0] + copy * set.size()),
               static_cast<std::int32_t>(pairs[k].pair[1] + images.number(other) * set.size()),
               set.attributes().bonds.list[k].order);
    }
  }
  made.put_in_order();
  return made.list;
}

// Makes the copies along the cell's vectors spheres of an enlarged cell, so that arrays have a row for each of them.
SphereFile with_copies(SphereFile file) {
  const SphereSet& set = file.spheres;
  if (!set.has_images()) return file;
  constexpr double kBytesPerCopy = 4 * 8 + 16 + 2 * 8;  // numbers in binary64, the set, ids
  const std::int64_t count = set.total_size();
  value_of(check_memory(kBytesPerCopy * static_cast<double>(count), grouped(count) + " spheres with their copies"));
  std::vector<std::int64_t> ids(static_cast<std::size_t>(count));
  std::iota(ids.begin(), ids.end(), 0);
  SphereSet all = rounded_again(set, std::move(ids));
  all.attributes().bonds.list = bonds_of_copies(set);
  if (set.cell()) {
    Cell cell = *set.cell();
    for (std::size_t axis = 0; axis < 3; ++axis)
      cell.vectors[axis] = double(set.images().counts[axis]) * cell.vectors[axis];
    all.cell() = cell;
  }
  file.spheres = std::move(all);
  return file;
}

SharedSpheres read(const std::vector<std::string>& words, const py::object& progress) {
  InputOptions options = request_of(words).input;
  take_saved_input(options);
  auto made = std::make_shared<Spheres>();
  wait_for(
      [&](Work& work) {
        const Watch watch(work.between(0, 1), &work.cancel);
        made->file = with_copies(read_input_file(options));
        made->name = options.input;
      },
      progress);
  return made;
}

py::array_t<double> centres(const Spheres& spheres) {
  const SphereSet& set = spheres.file.spheres;
  py::array_t<double> made({static_cast<py::ssize_t>(set.size()), py::ssize_t{3}});
  double* to = made.mutable_data();
  for (std::int64_t id = 0; id < set.size(); ++id) {
    const Vec3d centre = set.centre(id);
    for (int k = 0; k < 3; ++k) *to++ = centre[k];
  }
  return made;
}

py::array_t<double> radii(const Spheres& spheres) {
  const SphereSet& set = spheres.file.spheres;
  py::array_t<double> made(static_cast<py::ssize_t>(set.size()));
  double* const to = made.mutable_data();
  for (std::int64_t id = 0; id < set.size(); ++id) to[id] = set.radius(id);
  return made;
}

template <class T>
py::object array_or_none(const std::vector<T>& values) {
  if (values.empty()) return py::none();
  return array_from<T>(values, {static_cast<py::ssize_t>(values.size())});
}

py::object colours_or_none(const Spheres& spheres) {
  const std::vector<Vec3f>& colours = spheres.file.spheres.attributes().colour;
  if (colours.empty()) return py::none();
  std::vector<float> flat;
  flat.reserve(colours.size() * 3);
  for (const Vec3f& colour : colours) flat.insert(flat.end(), {colour.x, colour.y, colour.z});
  return array_from<float>(std::move(flat), {static_cast<py::ssize_t>(colours.size()), 3});
}

// A label and its number have the same name: `type` of LAMMPS.
std::string name_of_texts(const SphereAttributes& attributes, const NamedTexts& column) {
  return attributes.find_numbers(column.name) != nullptr ? column.name + "_text" : column.name;
}

py::list texts_of_spheres(const NamedTexts& column) {
  std::vector<py::str> distinct;
  distinct.reserve(column.texts.size());
  for (const std::string& text : column.texts) distinct.emplace_back(text);
  py::list texts(column.text_of_sphere.size());
  for (std::size_t i = 0; i < column.text_of_sphere.size(); ++i)
    texts[i] = distinct[static_cast<std::size_t>(column.text_of_sphere[i])];
  return texts;
}

std::vector<std::string> column_names(const Spheres& spheres) {
  const SphereAttributes& attributes = spheres.file.spheres.attributes();
  std::vector<std::string> names;
  for (const NamedNumbers& column : attributes.numbers) names.push_back(column.name);
  for (const NamedTexts& column : attributes.texts) names.push_back(name_of_texts(attributes, column));
  return names;
}

// Numbers as an array, texts as a list. None: there is no such column.
py::object column_or_none(const Spheres& spheres, const std::string& name) {
  const SphereAttributes& attributes = spheres.file.spheres.attributes();
  if (const NamedNumbers* const column = attributes.find_numbers(name))
    return array_from<double>(column->values, {static_cast<py::ssize_t>(column->values.size())});
  for (const NamedTexts& column : attributes.texts)
    if (name_of_texts(attributes, column) == name) return texts_of_spheres(column);
  return py::none();
}

py::dict columns(const Spheres& spheres) {
  py::dict made;
  for (const std::string& name : column_names(spheres)) made[py::str(name)] = column_or_none(spheres, name);
  return made;
}

// Those with an entry for each sphere.
std::vector<std::string> attribute_names(const Spheres& spheres) {
  const SphereAttributes& attributes = spheres.file.spheres.attributes();
  std::vector<std::string> names;
  if (!attributes.element.empty()) names.emplace_back("element");
  if (!attributes.type.empty()) names.emplace_back("type");
  if (!attributes.colour.empty()) names.emplace_back("colour");
  if (!attributes.opacity.empty()) names.emplace_back("opacity");
  for (std::string& name : column_names(spheres)) names.push_back(std::move(name));
  return names;
}

py::object cell_or_none(const Spheres& spheres) {
  const std::optional<Cell>& cell = spheres.file.spheres.cell();
  if (!cell) return py::none();
  std::vector<double> flat;
  for (const Vec3d& v : {cell->vectors[0], cell->vectors[1], cell->vectors[2], cell->origin})
    flat.insert(flat.end(), {v.x, v.y, v.z});
  return array_from<double>(std::move(flat), {4, 3});
}

std::array<bool, 3> periodic(const Spheres& spheres) {
  const std::optional<Cell>& cell = spheres.file.spheres.cell();
  return cell ? cell->periodic : std::array<bool, 3>{};
}

// The distance or angle of each row of positions, which are in range.
py::array_t<double> measured_rows(const Spheres& spheres, const py::array_t<std::int64_t, py::array::c_style>& rows,
                                  bool periodic) {
  const auto count = rows.shape(0);
  const auto each = static_cast<std::size_t>(rows.shape(1));
  py::array_t<double> made(count);
  double* const values = made.mutable_data();
  const std::int64_t* const ids = rows.data();
  const py::gil_scoped_release unlocked;
  const SphereSet& set = spheres.file.spheres;
  const std::optional<Lattice> lattice = periodic ? Lattice::of(set.cell()) : std::nullopt;
  for (py::ssize_t i = 0; i < count; ++i)
    values[i] = measured(set, {ids + static_cast<std::size_t>(i) * each, each}, lattice);
  return made;
}

// `name` names the argument in errors. With `periodic`, distances are to the nearest image in the set's periodic cell.
py::array_t<bool> select(const Spheres& spheres, const std::string& expression, const std::string& name,
                         bool periodic) {
  std::vector<std::uint8_t> mask;
  {
    const py::gil_scoped_release unlocked;
    const SphereSet* set = &spheres.file.spheres;
    SphereSet without_images;
    if (!periodic && set->cell()) {
      without_images = *set;
      without_images.cell().reset();
      set = &without_images;
    }
    mask = selected_or_fail(*set, expression, name);
  }
  py::array_t<bool> made(static_cast<py::ssize_t>(mask.size()));
  std::transform(mask.begin(), mask.end(), made.mutable_data(), [](std::uint8_t one) { return one != 0; });
  return made;
}

// As `bihive stats --json` prints it.
std::string statistics(const Spheres& spheres, const std::vector<std::string>& words) {
  const TreeParameters parameters = request_of(words).tree;
  std::string text;
  wait_for(
      [&](Work&) {
        const SphereSet& set = spheres.file.spheres;
        for (const Engine engine : {Engine::reference, Engine::wide})
          value_of(check_tree_memory(set, engine, parameters));
        const WideFacts wide = wide_facts(value_of(build_wide_tree(set, parameters)));
        const Timer timer;
        const Tree tree = build_reference_tree(set, parameters.for_reference());
        text = statistics_json(reference_facts(tree, timer.elapsed_ms()), wide, std::nullopt);
      },
      py::none());
  return text;
}

// The function of each number, in an array of the same shape.
py::array_t<double> each_number(const Array<double>& numbers, double (*function)(double)) {
  py::array_t<double> made(std::vector<py::ssize_t>(numbers.shape(), numbers.shape() + numbers.ndim()));
  std::transform(numbers.data(), numbers.data() + numbers.size(), made.mutable_data(), function);
  return made;
}

// Colours as from --colour-by, for numbers or texts without a set.
py::array_t<float> colours_of(const py::object& values, const std::string& how, const std::string& nan_colour) {
  const bool are_texts = py::isinstance<py::list>(values);
  SphereAttributes attributes;
  std::size_t count = 0;
  if (are_texts) {
    const auto texts = values.cast<std::vector<std::string>>();
    count = texts.size();
    attributes.texts.push_back(texts_from("values", texts));
  } else {
    attributes.numbers.push_back({"values", vector_from<double>(values.cast<Array<double>>())});
    count = attributes.numbers.front().values.size();
  }
  if (count == 0) return py::array_t<float>(std::vector<py::ssize_t>{0, 3});
  const std::vector<float> zeros(count);
  SphereSet set = value_of(SphereSet::from_world(zeros, zeros, zeros, zeros));
  set.attributes() = std::move(attributes);
  ColourBy asked = value_of(colour_by_from_text("values" + how));
  asked.nan_colour = nan_colour;
  std::vector<Vec3f> colours(count);
  value_of(colour_by(set, asked, std::vector<std::uint8_t>(count, 1), Transfer::srgb, colours));
  py::array_t<float> made({static_cast<py::ssize_t>(count), py::ssize_t{3}});
  float* to = made.mutable_data();
  for (const Vec3f& colour : colours)
    for (int k = 0; k < 3; ++k) *to++ = colour[k];
  return made;
}

// The bytes of a file of spheres, and what the format cannot hold. `format` is one of those that bihive/_spheres.py
// knows.
py::tuple written(const Spheres& spheres, const std::string& format) {
  const std::map<std::string, SphereFileFormat> formats{
      {"xyz", SphereFileFormat::xyz},  {"extxyz", SphereFileFormat::extended_xyz},
      {"csv", SphereFileFormat::csv},  {"npy", SphereFileFormat::npy},
      {"ply", SphereFileFormat::ply},  {"sdf", SphereFileFormat::sdf},
      {"mol2", SphereFileFormat::mol2}};
  WrittenSpheres made;
  Result<std::int64_t> added = std::int64_t{0};
  {
    const py::gil_scoped_release unlocked;
    const SphereFileFormat asked_for = formats.at(format);
    if (asked_for == SphereFileFormat::sdf || asked_for == SphereFileFormat::mol2) {
      SphereSet with_bonds = spheres.file.spheres;
      added = state_bonds(with_bonds, Sticks().reach);
      if (added) made = write_spheres(with_bonds, asked_for, spheres.file.title);
    } else {
      made = write_spheres(spheres.file.spheres, asked_for, spheres.file.title);
    }
  }
  if (value_of(added) > 0) made.left_out.push_back("bonds by distance: " + std::to_string(*added));
  return py::make_tuple(py::bytes(made.bytes), made.left_out);
}

}  // namespace

PictureRequest request_of(const std::vector<std::string>& words) {
  PictureRequest request;
  take_words(request, words);
  return request;
}

// Id and name of the value of each option of a picture; "": a switch.
std::vector<std::pair<std::string, std::string>> options_of_pictures() {
  std::vector<std::pair<std::string, std::string>> options;
  for (const RequestOption<PictureRequest>& row : picture_options()) options.emplace_back(row.id, row.value_name);
  return options;
}

void bind_spheres(py::module_& module) {
  module.def("options", options_of_pictures);
  module.def("options_of_pages", [] {
    std::vector<std::string> names;
    for (const RequestOption<PictureRequest>& row : picture_options())
      if (row.in_window && row.in_page) names.emplace_back(row.id);
    return names;
  });
  module.def("actions", look_action_names);
  module.def("colour_maps", colour_map_names);
  module.def("colour_map_of_file", [](const std::string& path) {
    std::vector<std::string> colours;
    for (const std::uint32_t rgb : value_of(read_colour_map(value_of(read_file(path)), path)))
      colours.push_back(text_of_colours({rgb}));
    return colours;
  });
  py::class_<Spheres, std::shared_ptr<Spheres>>(module, "Spheres")
      .def("__len__", [](const Spheres& s) { return s.file.spheres.size(); })
      .def_property_readonly("xyz", centres)
      .def_property_readonly("radius", radii)
      .def_property_readonly("element",
                             [](const Spheres& s) { return array_or_none(s.file.spheres.attributes().element); })
      .def_property_readonly("type", [](const Spheres& s) { return array_or_none(s.file.spheres.attributes().type); })
      .def_property_readonly("colour", colours_or_none)
      .def_property_readonly("opacity",
                             [](const Spheres& s) { return array_or_none(s.file.spheres.attributes().opacity); })
      .def_property_readonly("columns", columns)
      .def_property_readonly("attributes", attribute_names)
      .def("column", column_or_none)
      .def("part", part_of)
      .def("moved", moved)
      .def("with_columns", with_columns)
      .def("with_bonds", with_bonds)
      .def_property_readonly("bonds", bonds_of)
      .def_property_readonly("bonds_are_all",
                             [](const Spheres& s) { return s.file.spheres.attributes().bonds.are_all; })
      .def_property_readonly("cell", cell_or_none)
      .def_property_readonly("periodic", periodic)
      .def_property_readonly(
          "bounds",
          [](const Spheres& s) {
            const SphereSet::Bounds box = s.file.spheres.bounds();
            return array_from<double>({box.lo.x, box.lo.y, box.lo.z, box.hi.x, box.hi.y, box.hi.z}, {2, 3});
          })
      .def_property_readonly("nbytes", [](const Spheres& s) { return s.file.spheres.allocated_bytes(); })
      .def_property_readonly("name",
                             [](const Spheres& s) {
                               // A path need not be UTF-8.
                               return py::reinterpret_steal<py::object>(PyUnicode_DecodeFSDefaultAndSize(
                                   s.name.data(), static_cast<Py_ssize_t>(s.name.size())));
                             })
      .def_property_readonly("format", [](const Spheres& s) { return s.file.format; })
      .def_property_readonly("title", [](const Spheres& s) { return s.file.title; })
      .def_property_readonly("entry_id", [](const Spheres& s) { return s.file.entry_id; })
      .def_property_readonly("frames", [](const Spheres& s) { return s.file.frames; })
      .def_property_readonly("time_ps", [](const Spheres& s) { return s.file.time_ps; })
      .def_property_readonly("step", [](const Spheres& s) { return s.file.step; })
      .def_property_readonly("rules", [](const Spheres& s) { return s.file.rules; })
      .def_property_readonly("warnings", [](const Spheres& s) { return safe_texts(s.file.warnings); })
      .def("select", select)
      .def("measured", measured_rows)
      .def("what_there_is",
           [](const Spheres& s, const std::string& expression) {
             return safe_texts({what_there_is(s.file.spheres, expression)}).front();
           })
      .def("statistics", statistics)
      .def("written", written);
  module.def("spheres_from_arrays", spheres_from_arrays);
  module.def("read", read);
  module.def("reading_settings", [] {
    std::vector<std::string> ids;
    for (const ReadingSetting& row : reading_settings()) ids.emplace_back(row.id);
    return ids;
  });
  module.def("write_file", [](const std::string& path, const std::string& bytes) {
    const py::gil_scoped_release unlocked;
    value_of(write_file(path, bytes));
  });
  module.def("colours_of", colours_of);
  module.def("light_of_screen", [](const Array<double>& colours) { return each_number(colours, linear_from_srgb); });
  module.def("screen_of_light", [](const Array<double>& light) {
    return each_number(light, [](double one) { return one < 1 ? srgb_from_linear(one) : 1; });
  });
  module.def("linear_colour", [](const std::string& text) -> std::optional<std::array<double, 3>> {
    const std::optional<Vec3d> light = colour_from_text(text, Transfer::srgb);
    if (!light) return std::nullopt;
    return std::array<double, 3>{light->x, light->y, light->z};
  });
  module.def("check_selection", [](const std::string& text) {
    if (const Status status = check_selection(text); !status) fail_selection("select", text, status.error());
  });
  module.def("atomic_number", [](const std::string& symbol) { return atomic_number(symbol); });
  module.def("element_symbol", element_symbol);
  module.def("van_der_waals_radius", van_der_waals_radius);
}

}  // namespace bihive::python
