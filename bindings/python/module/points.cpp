// The queries of bihive/wide/point_queries.h for arrays of points.

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
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

/// Points between two checks for Ctrl-C: some tenths of a second. The calling thread does the work, because to make
/// another takes twenty times as long as the answer for a single point.
constexpr std::int64_t kPointsBetweenLooks = 65536;

using Points = py::array_t<double, py::array::c_style>;  // (n, 3)

using Mask = std::optional<py::array_t<std::uint8_t, py::array::c_style>>;     // a byte for each sphere of the tree
using Exclude = std::optional<py::array_t<std::int64_t, py::array::c_style>>;  // a sphere, or -1, for each point

PointOptions options_of(const RayTree& tree, const Mask& mask, bool to_centre) {
  PointOptions options;
  options.to = to_centre ? DistanceTo::centre : DistanceTo::surface;
  options.mask = mask ? mask->data() : nullptr;
  options.threads = tree.threads;
  if (tree.images) options.images = &*tree.images;
  return options;
}

// For the points of a piece that begins with number `first`.
PointOptions without_own(PointOptions options, const Exclude& exclude, std::int64_t first) {
  if (exclude) options.exclude = exclude->data() + first;
  return options;
}

// Calls answer(points of the piece, first point) piece by piece, until Ctrl-C, without Python's lock.
template <class Answer>
void answer_in_pieces(const Points& points, const Answer& answer) {
  const double* const xyz = points.data();
  const std::int64_t count = points.shape(0);
  SignalWatch watch;
  {
    const py::gil_scoped_release unlocked;
    for (std::int64_t first = 0; first < count && !watch.cancelled(); first += kPointsBetweenLooks)
      answer(PointSpan::rows(xyz + 3 * first, std::min(kPointsBetweenLooks, count - first)), first);
  }
  watch.rethrow();
}

// Distances and positions, (n, k) each.
py::tuple nearest(const RayTree& tree, const Points& points, std::int64_t k, double within, const Mask& mask,
                  const Exclude& exclude, bool to_centre) {
  const WideTree& wide = wide_tree_for(tree, "nearest");
  const PointOptions options = options_of(tree, mask, to_centre);
  py::array_t<double> distance({points.shape(0), static_cast<py::ssize_t>(k)});
  py::array_t<std::int64_t> id({points.shape(0), static_cast<py::ssize_t>(k)});
  double* const to_distance = distance.mutable_data();
  std::int64_t* const to_id = id.mutable_data();
  answer_in_pieces(points, [&](const PointSpan& span, std::int64_t first) {
    const NearestSpheres found = value_of(nearest_spheres(wide, span, k, within, without_own(options, exclude, first)));
    std::copy(found.distance.begin(), found.distance.end(), to_distance + first * k);
    std::copy(found.sphere_id.begin(), found.sphere_id.end(), to_id + first * k);
  });
  return py::make_tuple(distance, id);
}

// For each point the index of its first sphere, and the end of all; positions; distances.
py::tuple within(const RayTree& tree, const Points& points, const Points& limits, const Mask& mask,
                 const Exclude& exclude, bool to_centre) {
  const WideTree& wide = wide_tree_for(tree, "within");
  const PointOptions options = options_of(tree, mask, to_centre);
  SphereLists all;
  all.begin.push_back(0);
  answer_in_pieces(points, [&](const PointSpan& span, std::int64_t first) {
    const SphereLists some =
        value_of(spheres_within(wide, span, limits.data() + first, without_own(options, exclude, first)));
    const auto before = static_cast<std::int64_t>(all.sphere_id.size());
    for (std::size_t i = 1; i < some.begin.size(); ++i) all.begin.push_back(before + some.begin[i]);
    all.sphere_id.insert(all.sphere_id.end(), some.sphere_id.begin(), some.sphere_id.end());
    all.distance.insert(all.distance.end(), some.distance.begin(), some.distance.end());
  });
  const auto size = static_cast<py::ssize_t>(all.sphere_id.size());
  const auto places = static_cast<py::ssize_t>(all.begin.size());
  return py::make_tuple(array_from(std::move(all.begin), {places}), array_from(std::move(all.sphere_id), {size}),
                        array_from(std::move(all.distance), {size}));
}

// For each point the number of its spheres.
py::array_t<std::int64_t> count_near(const RayTree& tree, const Points& points, const Points& limits, const Mask& mask,
                                     const Exclude& exclude, bool to_centre) {
  const WideTree& wide = wide_tree_for(tree, "count_within");
  const PointOptions options = options_of(tree, mask, to_centre);
  py::array_t<std::int64_t> counts(points.shape(0));
  std::int64_t* const to = counts.mutable_data();
  answer_in_pieces(points, [&](const PointSpan& span, std::int64_t first) {
    const std::vector<std::int64_t> found =
        value_of(count_within(wide, span, limits.data() + first, without_own(options, exclude, first)));
    std::copy(found.begin(), found.end(), to + first);
  });
  return counts;
}

// Both positions and the distance of each pair.
py::tuple pairs(const RayTree& tree, double reach, const Mask& mask, bool to_centre) {
  const WideTree& wide = wide_tree_for(tree, "pairs");
  const PointOptions options = options_of(tree, mask, to_centre);
  SpherePairs found;
  {
    const py::gil_scoped_release unlocked;
    found = value_of(sphere_pairs(wide, tree.spheres->file.spheres, reach, options));
  }
  const auto size = static_cast<py::ssize_t>(found.distance.size());
  return py::make_tuple(array_from(std::move(found.first), {size}), array_from(std::move(found.second), {size}),
                        array_from(std::move(found.distance), {size}));
}

}  // namespace

void bind_points(TreeClass& tree) {
  tree.def("nearest", nearest).def("within", within).def("count_within", count_near).def("pairs", pairs);
}

}  // namespace bihive::python
