// The queries of bihive/wide/point_queries.h for arrays of points.

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "arrays.h"
#include "bihive/wide/point_queries.h"
#include "errors.h"
#include "tree.h"
#include "waiting.h"

namespace py = pybind11;

namespace bihive::python {
namespace {

using Points = py::array_t<double, py::array::c_style>;  // (n, 3)

using Mask = std::optional<py::array_t<std::uint8_t, py::array::c_style>>;     // a byte for each sphere of the tree
using Exclude = std::optional<py::array_t<std::int64_t, py::array::c_style>>;  // a sphere, or -1, for each point

PointOptions options_of(const RayTree& tree, const Mask& mask, const Exclude& exclude, bool to_centre) {
  PointOptions options;
  options.to = to_centre ? DistanceTo::centre : DistanceTo::surface;
  options.mask = mask ? mask->data() : nullptr;
  options.threads = tree.threads;
  if (tree.images) options.images = &*tree.images;
  if (exclude) options.exclude = exclude->data();
  return options;
}

PointSpan span_of(const Points& points) {
  return PointSpan::rows(points.data(), points.shape(0));
}

// The answer of a query that find() asks on this thread, without Python's lock, until Ctrl-C.
template <class Answer, class Find>
Answer answer_of(const Find& find) {
  Answer answer;
  do_query([&] { answer = value_of(find()); });
  return answer;
}

// Distances and positions, (n, k) each.
py::tuple nearest(const RayTree& tree, const Points& points, std::int64_t k, double within, const Mask& mask,
                  const Exclude& exclude, bool to_centre) {
  const WideTree& wide = wide_tree_for(tree, "nearest");
  const PointOptions options = options_of(tree, mask, exclude, to_centre);
  const PointSpan span = span_of(points);
  NearestSpheres found = answer_of<NearestSpheres>([&] { return nearest_spheres(wide, span, k, within, options); });
  const std::vector<py::ssize_t> shape{points.shape(0), static_cast<py::ssize_t>(k)};
  return py::make_tuple(array_from(std::move(found.distance), shape), array_from(std::move(found.sphere_id), shape));
}

// For each point the index of its first sphere, and the end of all; positions; distances.
py::tuple within(const RayTree& tree, const Points& points, const Points& limits, const Mask& mask,
                 const Exclude& exclude, bool to_centre) {
  const WideTree& wide = wide_tree_for(tree, "within");
  const PointOptions options = options_of(tree, mask, exclude, to_centre);
  const PointSpan span = span_of(points);
  const double* const limit = limits.data();
  SphereLists found = answer_of<SphereLists>([&] { return spheres_within(wide, span, limit, options); });
  const auto size = static_cast<py::ssize_t>(found.sphere_id.size());
  const auto places = static_cast<py::ssize_t>(found.begin.size());
  return py::make_tuple(array_from(std::move(found.begin), {places}), array_from(std::move(found.sphere_id), {size}),
                        array_from(std::move(found.distance), {size}));
}

// For each point the number of its spheres.
py::array count_near(const RayTree& tree, const Points& points, const Points& limits, const Mask& mask,
                     const Exclude& exclude, bool to_centre) {
  const WideTree& wide = wide_tree_for(tree, "count_within");
  const PointOptions options = options_of(tree, mask, exclude, to_centre);
  const PointSpan span = span_of(points);
  const double* const limit = limits.data();
  using Counts = std::vector<std::int64_t>;
  Counts found = answer_of<Counts>([&] { return bihive::count_within(wide, span, limit, options); });
  return array_from(std::move(found), {points.shape(0)});
}

// Both positions and the distance of each pair.
py::tuple pairs(const RayTree& tree, double reach, const Mask& mask, bool to_centre) {
  const WideTree& wide = wide_tree_for(tree, "pairs");
  const PointOptions options = options_of(tree, mask, {}, to_centre);
  SpherePairs found =
      answer_of<SpherePairs>([&] { return sphere_pairs(wide, tree.spheres->file.spheres, reach, options); });
  const auto size = static_cast<py::ssize_t>(found.distance.size());
  return py::make_tuple(array_from(std::move(found.first), {size}), array_from(std::move(found.second), {size}),
                        array_from(std::move(found.distance), {size}));
}

}  // namespace

void bind_points(TreeClass& tree) {
  tree.def("nearest", nearest).def("within", within).def("count_within", count_near).def("pairs", pairs);
}

}  // namespace bihive::python
