#include "bihive/io/formats/arrays/particle_layout.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "bihive/base/memory.h"
#include "bihive/io/assemble/unit_cell.h"
#include "bihive/io/elements.h"
#include "bihive/io/text/sphere_table.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

// The numbers of one frame; of arrays that do not move, all. `rows`: these of them, for arrays with a row for each
// particle.
Result<std::vector<double>> numbers_at(const ArrayFile& file, const FramedArray& of, std::int64_t frame,
                                       std::optional<RowRange> rows = {}) {
  std::vector<std::int64_t> begin(of.array->lengths.size(), 0), lengths = of.array->lengths;
  if (of.moves) {
    if (frame >= lengths[0])
      return Error{"the array " + quote(of.array->name) + " has " + std::to_string(lengths[0]) +
                       " frames, fewer than the places",
                   file.path(), 0, 0, ""};
    begin[0] = frame;
    lengths[0] = 1;
  }
  if (rows) {
    const std::size_t particles = of.moves ? 1 : 0;
    begin[particles] = rows->first;
    lengths[particles] = rows->count();
  }
  Result<std::vector<double>> values = file.read(*of.array, begin, lengths);
  if (values && of.fill)
    for (double& value : *values)
      if (value == *of.fill) value = std::numeric_limits<double>::quiet_NaN();
  if (values && of.unit != 1)
    for (double& value : *values) value *= of.unit;
  return values;
}

bool all_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

// The cell of the frame, into a RawSpheres or a TrajectoryFrame. Numbers that make no cell are told, unless all its
// lengths are 0; an array that cannot be read is an error.
template <class Target>
Status take_cell_of(const ArrayFile& file, const ParticleLayout& layout, std::int64_t frame, Target& target) {
  std::vector<double> lengths;
  std::optional<Cell>& cell = target.cell;
  if (layout.edges) {
    Result<std::vector<double>> edges = numbers_at(file, layout.edges, frame);
    if (!edges) return edges.error();
    lengths = std::move(*edges);
    const std::vector<double>& v = lengths;
    if (v.size() == 3) cell = Cell{{}, {Vec3d{v[0], 0, 0}, Vec3d{0, v[1], 0}, Vec3d{0, 0, v[2]}}};
    if (v.size() == 9) cell = Cell{{}, {Vec3d{v[0], v[1], v[2]}, Vec3d{v[3], v[4], v[5]}, Vec3d{v[6], v[7], v[8]}}};
    if (!all_finite(v)) cell.reset();
  } else if (layout.lengths && layout.angles) {
    Result<std::vector<double>> stated = numbers_at(file, layout.lengths, frame);
    if (!stated) return stated.error();
    lengths = std::move(*stated);
    const Result<std::vector<double>> angles = numbers_at(file, layout.angles, frame);
    if (!angles) return angles.error();
    if (lengths.size() == 3 && angles->size() == 3)
      cell = unit_cell({lengths[0], lengths[1], lengths[2], (*angles)[0], (*angles)[1], (*angles)[2]});
  }
  if (std::all_of(lengths.begin(), lengths.end(), [](double value) { return value == 0; })) {
    cell.reset();
    return Done{};
  }
  if (!cell) target.warnings.push_back(unreadable_cell(frame));
  if (cell) cell->periodic = layout.periodic;
  if (cell && layout.corner) {
    const Result<std::vector<double>> corner = numbers_at(file, layout.corner, frame);
    if (!corner) return corner.error();
    if (corner->size() == 3 && all_finite(*corner)) cell->origin = {(*corner)[0], (*corner)[1], (*corner)[2]};
  }
  return Done{};
}

// Time and step of the frame, into a RawSpheres or a TrajectoryFrame.
template <class Target>
Status take_when(const ArrayFile& file, const ParticleLayout& layout, std::int64_t frame, Target& target) {
  const auto from = [&](const FramedArray& array, const std::optional<double>& first,
                        const std::optional<double>& apart) -> Result<std::optional<double>> {
    if (apart) return std::optional<double>(first.value_or(0) + *apart * static_cast<double>(frame));
    if (!array) return std::optional<double>();
    const Result<std::vector<double>> values = numbers_at(file, array, frame);
    if (!values) return values.error();
    if (values->size() != 1 || !std::isfinite(values->front())) return std::optional<double>();
    return std::optional<double>(values->front());
  };
  const Result<std::optional<double>> time = from(layout.time_ps, layout.first_time_ps, layout.time_apart_ps);
  if (!time) return time.error();
  target.time_ps = *time;
  const Result<std::optional<double>> step = from(layout.step, layout.first_step, layout.steps_apart);
  if (!step) return step.error();
  if (*step && std::abs(**step) < 0x1p53) target.step = static_cast<std::int64_t>(**step);
  return Done{};
}

// The hint of errors about positions that are no numbers.
std::string about_fill(const ParticleLayout& layout) {
  return layout.places.fill ? "numbers that were never written are none" : "";
}

// Velocities and forces of the frame.
Status take_vectors(const ArrayFile& file, const ParticleLayout& layout, std::int64_t frame, TrajectoryFrame& made) {
  for (const ParticleColumn& column : layout.columns) {
    if (column.names.size() != 3 || (column.names[0] != "vx" && column.names[0] != "fx")) continue;
    const Result<std::vector<double>> values = numbers_at(file, column.of, frame);
    if (!values) return values.error();
    if (values->size() != 3 * made.x.size()) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      NamedNumbers numbers{column.names[axis], {}};
      for (std::size_t i = axis; i < values->size(); i += 3) numbers.values.push_back((*values)[i]);
      made.numbers.push_back(std::move(numbers));
    }
  }
  return Done{};
}

// Places of atoms that have ids come in the order of these, as the atoms of their file do.
Status sort_by_id(const ArrayFile& file, const ParticleLayout& layout, std::int64_t frame, TrajectoryFrame& made) {
  for (const ParticleColumn& column : layout.columns) {
    if (lower_case(column.name) != "id") continue;
    const Result<std::vector<double>> ids = numbers_at(file, column.of, frame);
    if (!ids) return ids.error();
    if (ids->size() != made.x.size()) continue;
    const IdOrder order = order_of_ids(*ids);
    if (order.kind != RowIds::sorted) return Done{};
    for (std::vector<double>* const values : {&made.x, &made.y, &made.z}) put_in_order(*values, order.rows);
    for (NamedNumbers& numbers : made.numbers) put_in_order(numbers.values, order.rows);
    return Done{};
  }
  return Done{};
}

// Labels of numbers, as HDF5's enumerations have: elements if one is an element, and texts.
void take_labels(const std::vector<std::pair<double, std::string>>& labels, const std::vector<double>& values,
                 SphereAttributes& attributes) {
  const auto label_of = [&](double value) {
    const auto found = std::find_if(labels.begin(), labels.end(), [&](const auto& one) { return one.first == value; });
    return found == labels.end() ? std::string("?") : found->second;
  };
  TextCollector texts;
  std::vector<std::uint8_t> elements;
  bool known = false;
  for (const double value : values) {
    const std::string label = label_of(value);
    texts.add(label);
    elements.push_back(static_cast<std::uint8_t>(atomic_number(label)));
    known = known || elements.back() != 0;
  }
  if (known) attributes.element = std::move(elements);
  attributes.texts.push_back(printable_texts(texts.take("type")));
}

}  // namespace

std::vector<std::int64_t> FramedArray::lengths() const {
  return {array->lengths.begin() + (moves ? 1 : 0), array->lengths.end()};
}

std::int64_t frame_count(const ParticleLayout& layout) {
  return layout.places.moves ? layout.places.array->lengths[0] : 1;
}

std::int64_t particle_count(const ParticleLayout& layout) {
  return layout.places.lengths()[0];
}

Result<RawSpheres> read_particles(const ArrayFile& file, const ParticleLayout& layout, std::int64_t frame,
                                  const ColumnChoice& choice, RowChunk chunk) {
  const RowRange rows = chunk.of(particle_count(layout));
  const std::int64_t count = rows.count();
  const std::int64_t axes = layout.places.lengths()[1];
  const Result<std::vector<double>> places = numbers_at(file, layout.places, frame, rows);
  if (!places) return places.error();

  // The columns of a table: the places, then all that the file says of each particle.
  std::vector<TableColumn> columns{{"x", ColumnRole::x}, {"y", ColumnRole::y}, {"z", ColumnRole::z}};
  std::vector<std::vector<double>> arrays;
  std::vector<std::pair<std::size_t, std::size_t>> sources;  // of the columns behind: an array, and its part
  std::vector<std::size_t> widths;
  const ParticleColumn* labelled = nullptr;
  std::vector<double> labelled_values;
  double total = 0;  // bytes; several names may stand for the same ones
  for (const ParticleColumn& column : layout.columns) {
    Result<std::vector<double>> values = numbers_at(file, column.of, frame, rows);
    if (!values) return values.error();
    total += static_cast<double>(values->size() * sizeof(double));
    if (Status status = check_memory(total, "its arrays"); !status)
      return Error{status.error().message, file.path(), 0, 0, ""};
    const std::size_t width = values->size() / static_cast<std::size_t>(std::max<std::int64_t>(count, 1));
    if (width == 0 || columns.size() + width > SphereTable::kMostColumns) continue;
    if (column.name == "type" && labelled == nullptr && !file.labels(*column.of.array).empty()) {
      labelled = &column;
      labelled_values = *values;
    }
    for (std::size_t i = 0; i < width; ++i) {
      const std::string name = i < column.names.size() ? column.names[i]
                               : width == 1            ? column.name
                                                       : column.name + "_" + std::to_string(i + 1);
      ColumnRole role = width == 1 ? usual_role(name) : ColumnRole::number;
      if (role == ColumnRole::x || role == ColumnRole::y || role == ColumnRole::z) role = ColumnRole::number;
      columns.push_back({name, role});
      sources.emplace_back(arrays.size(), i);
    }
    widths.push_back(width);
    arrays.push_back(std::move(*values));
  }
  const auto bad = [&](const std::string& what) { return Error{what, file.path(), 0, 0, ""}; };
  if (const std::string fault = choose_columns(choice, columns); !fault.empty()) return bad(fault);
  SphereTable table(columns);
  if (const std::string fault = table.columns_fault(); !fault.empty()) return bad(fault);
  std::vector<double> row(columns.size());
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      row[axis] = axis < static_cast<std::size_t>(axes) ? (*places)[i * static_cast<std::size_t>(axes) + axis] : 0;
    for (std::size_t k = 0; k < sources.size(); ++k)
      row[3 + k] = arrays[sources[k].first][i * widths[sources[k].first] + sources[k].second];
    if (const std::string fault = table.add_numbers(row.data()); !fault.empty())
      return Error{"frame " + std::to_string(frame) + ", particle " +
                       std::to_string(rows.first + static_cast<std::int64_t>(i)) + " (from 0): " + fault,
                   file.path(), 0, 0, about_fill(layout)};
  }
  const std::string names = table.column_names();
  const IdOrder order = table.sort_by_id();
  RawSpheres spheres = std::move(table).take();
  note_id_order(order, file.path(), std::nullopt, spheres);
  if (order.kind == RowIds::sorted && labelled != nullptr) put_in_order(labelled_values, order.rows);
  spheres.format = layout.format;
  spheres.frames = frame_count(layout);
  spheres.rules.insert(spheres.rules.begin(), "arrays as columns: " + names);
  spheres.rules.insert(spheres.rules.end(), layout.rules.begin(), layout.rules.end());
  if (labelled != nullptr) take_labels(file.labels(*labelled->of.array), labelled_values, spheres.attributes);
  spheres.warnings.insert(spheres.warnings.end(), layout.warnings.begin(), layout.warnings.end());
  if (Status status = take_cell_of(file, layout, frame, spheres); !status) return status.error();
  if (Status status = take_when(file, layout, frame, spheres); !status) return status.error();
  return spheres;
}

Result<TrajectoryFrame> read_places(const ArrayFile& file, const ParticleLayout& layout, std::int64_t frame) {
  const auto axes = static_cast<std::size_t>(layout.places.lengths()[1]);
  const Result<std::vector<double>> places = numbers_at(file, layout.places, frame);
  if (!places) return places.error();
  TrajectoryFrame made;
  for (std::size_t i = 0; i < places->size(); i += axes) {
    made.x.push_back((*places)[i]);
    made.y.push_back((*places)[i + 1]);
    made.z.push_back(axes > 2 ? (*places)[i + 2] : 0);
    for (std::size_t axis = 0; axis < axes; ++axis)
      if (const char* fault = coordinate_fault((*places)[i + axis]))
        return Error{"frame " + std::to_string(frame) + ": the place of atom " + std::to_string(i / axes) + " " + fault,
                     file.path(), 0, 0, about_fill(layout)};
  }
  if (Status status = take_cell_of(file, layout, frame, made); !status) return status.error();
  if (Status status = take_vectors(file, layout, frame, made); !status) return status.error();
  if (Status status = sort_by_id(file, layout, frame, made); !status) return status.error();
  if (Status status = take_when(file, layout, frame, made); !status) return status.error();
  return made;
}

double angstrom_of(const std::optional<std::string>& unit) {
  const std::string lower = unit ? lower_case(*unit) : "";
  const auto begins = [&](std::string_view word) { return lower.rfind(word, 0) == 0; };
  if (begins("nanomet") || lower == "nm") return 10;
  if (begins("picomet") || lower == "pm") return 0.01;
  if (begins("microm") || lower == "um") return 1e4;
  if (begins("bohr")) return 0.529177210903;
  return 1;
}

std::optional<double> picoseconds_of(const std::optional<std::string>& unit) {
  const std::string lower = unit ? lower_case(*unit) : "";
  const auto begins = [&](std::string_view word) { return lower.rfind(word, 0) == 0; };
  if (begins("picosec") || lower == "ps") return 1;
  if (begins("femtosec") || lower == "fs") return 1e-3;
  if (begins("nanosec") || lower == "ns") return 1e3;
  return std::nullopt;
}

}  // namespace bihive
