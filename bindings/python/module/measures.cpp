#include "measures.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "arrays.h"
#include "bihive/base/watch.h"
#include "bihive/measure/buried_area.h"
#include "bihive/measure/union_measures.h"
#include "errors.h"
#include "spheres.h"
#include "waiting.h"

namespace py = pybind11;

namespace bihive::python {
namespace {

using Mask = std::optional<py::array_t<std::uint8_t, py::array::c_style>>;

// `mask`: a byte for each sphere.
MeasureOptions options_of(double probe, const Mask& mask, bool periodic, int threads) {
  MeasureOptions options;
  options.probe = probe;
  options.mask = mask ? mask->data() : nullptr;
  options.periodic = periodic;
  options.threads = threads;
  return options;
}

template <class T>
py::array_t<T> column_from(std::vector<T> values) {
  const auto count = static_cast<py::ssize_t>(values.size());
  return array_from(std::move(values), {count});
}

// Rows of three.
template <class Row, class Number>
py::array_t<Number> rows_from(const std::vector<Row>& rows, const Number* (*numbers_of)(const Row&)) {
  py::array_t<Number> made({static_cast<py::ssize_t>(rows.size()), py::ssize_t{3}});
  Number* to = made.mutable_data();
  for (const Row& row : rows) to = std::copy_n(numbers_of(row), 3, to);
  return made;
}

template <class Row>
py::array_t<double> numbers_from(const std::vector<Row>& rows, double Row::*member) {
  std::vector<double> numbers;
  for (const Row& row : rows) numbers.push_back(row.*member);
  return column_from(std::move(numbers));
}

template <class Row>
py::list ids_from(std::vector<Row>& rows) {
  py::list lists;
  for (Row& row : rows) lists.append(column_from(std::move(row.spheres)));
  return lists;
}

// By the names of the fields of bihive.Measures; "undecided" is the number of undecided spheres. Without `whole`,
// cavities and volumes of single spheres, which take longer than all the rest, are left empty.
py::dict union_measures(const Spheres& spheres, double probe, const Mask& mask, bool periodic, bool whole,
                        bool derivatives, int threads, const py::object& progress) {
  MeasureOptions options = options_of(probe, mask, periodic, threads);
  options.cavities = options.sphere_volumes = whole;
  options.derivatives = derivatives;
  UnionMeasures measures;
  const auto work = [&](Work& work_done) {
    const Watch watch(work_done.between(0, 1), &work_done.cancel);
    measures = value_of(measure_union(spheres.file.spheres, options));
  };
  wait_for(work, progress);
  py::dict made;
  made["area"] = measures.area;
  made["volume"] = measures.volume;
  made["area_error"] = measures.area_error;
  made["volume_error"] = measures.volume_error;
  made["sphere_area"] = column_from(std::move(measures.sphere_area));
  made["sphere_volume"] = column_from(std::move(measures.sphere_volume));
  made["components"] = measures.components;
  made["cavity_volume"] = numbers_from(measures.cavities, &Cavity::volume);
  made["cavity_area"] = numbers_from(measures.cavities, &Cavity::area);
  made["cavity_spheres"] = ids_from(measures.cavities);
  made["cell_volume"] = measures.cell_volume;
  made["porosity"] = measures.porosity;
  made["porosity_error"] = measures.porosity_error;
  made["channel_area"] = numbers_from(measures.channels, &PercolatingSurface::area);
  py::list translations;
  for (const PercolatingSurface& channel : measures.channels)
    translations.append(rows_from<std::array<std::int64_t, 3>, std::int64_t>(
        channel.translations, [](const std::array<std::int64_t, 3>& row) { return row.data(); }));
  made["channel_translations"] = translations;
  made["channel_spheres"] = ids_from(measures.channels);
  made["undecided"] = measures.undecided_spheres;
  if (!derivatives) return made;
  const std::vector<MeasureDerivatives>& rows = measures.derivatives;
  made["area_by_centre"] =
      rows_from<MeasureDerivatives, double>(rows, [](const MeasureDerivatives& row) { return &row.area_by_centre.x; });
  made["area_by_radius"] = numbers_from(rows, &MeasureDerivatives::area_by_radius);
  made["volume_by_centre"] = rows_from<MeasureDerivatives, double>(
      rows, [](const MeasureDerivatives& row) { return &row.volume_by_centre.x; });
  made["volume_by_radius"] = numbers_from(rows, &MeasureDerivatives::volume_by_radius);
  return made;
}

// First, second, image, area.
py::tuple contacts(const Spheres& spheres, double probe, const Mask& mask, bool periodic, int threads) {
  MeasureOptions options = options_of(probe, mask, periodic, threads);
  options.contacts = true;
  UnionMeasures measures;
  wait_for([&](Work&) { measures = value_of(measure_union(spheres.file.spheres, options)); }, py::none());
  std::vector<std::int64_t> first, second;
  for (const Contact& contact : measures.contacts) {
    first.push_back(contact.first);
    second.push_back(contact.second);
  }
  return py::make_tuple(
      column_from(std::move(first)), column_from(std::move(second)),
      rows_from<Contact, std::int64_t>(measures.contacts, [](const Contact& contact) { return contact.image.data(); }),
      numbers_from(measures.contacts, &Contact::area));
}

// `groups`: of each sphere one below `count`, or -1. A matrix; on the diagonal each group alone.
py::array_t<double> buried_area(const Spheres& spheres, double probe,
                                const py::array_t<std::int32_t, py::array::c_style>& groups, py::ssize_t count,
                                bool periodic, int threads) {
  const std::vector<std::int32_t> group_of_sphere(groups.data(), groups.data() + groups.size());
  const MeasureOptions options = options_of(probe, std::nullopt, periodic, threads);
  BuriedAreas areas;
  wait_for([&](Work&) { areas = value_of(buried_areas(spheres.file.spheres, group_of_sphere, options)); }, py::none());
  const auto known = static_cast<py::ssize_t>(areas.alone.size());
  std::vector<double> matrix(static_cast<std::size_t>(count * count), 0.0);
  for (py::ssize_t g = 0; g < known; ++g)
    for (py::ssize_t h = 0; h < known; ++h)
      matrix[static_cast<std::size_t>(g * count + h)] =
          g == h ? areas.alone[static_cast<std::size_t>(g)] : areas.buried[static_cast<std::size_t>(g * known + h)];
  return array_from(std::move(matrix), {count, count});
}

}  // namespace

void bind_measures(py::module_& module) {
  module.def("union_measures", union_measures);
  module.def("contacts", contacts);
  module.def("buried_area", buried_area);
}

}  // namespace bihive::python
