// Measures of the union of a tree's spheres.
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "bihive.h"
#include "bihive/measure/buried_area.h"
#include "bihive/measure/union_measures.h"
#include "c_errors.h"
#include "c_progress.h"
#include "c_tree.h"

namespace bihive::c {
namespace {

// Checks the arguments that all functions share, measures with the options that `choose` sets, and hands the result to
// `take`.
template <class Choose, class Take>
int measuring(const bihive_tree* tree, double probe, const uint8_t* mask, int threads, const Choose& choose,
              const Take& take) {
  return guarded_query([&] {
    if (tree == nullptr) return failed("the tree is NULL");
    if (threads < 0) return failed("the number of threads is negative; 0 takes all");
    MeasureOptions options;
    options.probe = probe;
    options.mask = mask;
    options.threads = threads;
    options.periodic = tree->images.has_value();
    choose(options);
    const auto measures = measure_union(tree->spheres, options);
    return measures ? take(*measures) : failed(measures.error());
  });
}

}  // namespace
}  // namespace bihive::c

using namespace bihive::c;  // NOLINT(google-build-using-namespace)

int bihive_measure(const bihive_tree* tree, double probe, const uint8_t* mask, int threads, double* area,
                   double* volume, double* areas) {
  return measuring(
      tree, probe, mask, threads, [](bihive::MeasureOptions&) {},
      [&](const bihive::UnionMeasures& made) {
        if (area != nullptr) *area = made.area;
        if (volume != nullptr) *volume = made.volume;
        if (areas != nullptr) std::copy(made.sphere_area.begin(), made.sphere_area.end(), areas);
        return kDone;
      });
}

int bihive_porosity(const bihive_tree* tree, double probe, const uint8_t* mask, int threads, double* porosity,
                    double* error) {
  return measuring(
      tree, probe, mask, threads, [](bihive::MeasureOptions&) {},
      [&](const bihive::UnionMeasures& made) {
        if (porosity == nullptr) return failed("the place for the porosity is NULL");
        if (std::isnan(made.porosity))
          return failed("a porosity needs a tree in a cell that repeats along three vectors");
        *porosity = made.porosity;
        if (error != nullptr) *error = made.porosity_error;
        return kDone;
      });
}

int bihive_sphere_volumes(const bihive_tree* tree, double probe, const uint8_t* mask, int threads, double* volumes) {
  const auto choose = [](bihive::MeasureOptions& options) { options.sphere_volumes = true; };
  return measuring(tree, probe, mask, threads, choose, [&](const bihive::UnionMeasures& made) {
    if (volumes == nullptr) return failed("the place for the volumes is NULL");
    std::copy(made.sphere_volume.begin(), made.sphere_volume.end(), volumes);
    return kDone;
  });
}

int bihive_measure_derivatives(const bihive_tree* tree, double probe, const uint8_t* mask, int threads,
                               double* area_by_centre, double* area_by_radius, double* volume_by_centre,
                               double* volume_by_radius) {
  const auto choose = [](bihive::MeasureOptions& options) { options.derivatives = true; };
  return measuring(tree, probe, mask, threads, choose, [&](const bihive::UnionMeasures& made) {
    for (std::size_t i = 0; i < made.derivatives.size(); ++i) {
      const bihive::MeasureDerivatives& own = made.derivatives[i];
      for (int axis = 0; axis < 3; ++axis) {
        if (area_by_centre != nullptr) area_by_centre[3 * i + axis] = own.area_by_centre[axis];
        if (volume_by_centre != nullptr) volume_by_centre[3 * i + axis] = own.volume_by_centre[axis];
      }
      if (area_by_radius != nullptr) area_by_radius[i] = own.area_by_radius;
      if (volume_by_radius != nullptr) volume_by_radius[i] = own.volume_by_radius;
    }
    return kDone;
  });
}

int bihive_contacts(const bihive_tree* tree, double probe, const uint8_t* mask, int threads, bihive_lists** lists) {
  const auto choose = [](bihive::MeasureOptions& options) { options.contacts = true; };
  return measuring(tree, probe, mask, threads, choose, [&](const bihive::UnionMeasures& measures) {
    if (lists == nullptr) return failed("the place for the lists is NULL");
    auto made = std::make_unique<bihive_lists>();
    made->begin.assign(static_cast<std::size_t>(tree->spheres.size()) + 1, 0);
    for (const bihive::Contact& contact : measures.contacts) {
      ++made->begin[static_cast<std::size_t>(contact.first) + 1];
      made->spheres.push_back(contact.second);
      made->distances.push_back(contact.area);
    }
    for (std::size_t i = 1; i < made->begin.size(); ++i) made->begin[i] += made->begin[i - 1];
    *lists = made.release();
    return kDone;
  });
}

int bihive_buried_areas(const bihive_tree* tree, double probe, const int32_t* groups, int64_t count, int threads,
                        double* buried) {
  return guarded([&] {
    if (tree == nullptr || groups == nullptr || buried == nullptr) return failed("tree, groups or areas are NULL");
    if (threads < 0) return failed("the number of threads is negative; 0 takes all");
    for (std::int64_t i = 0; i < tree->spheres.size(); ++i)
      if (groups[i] < -1 || groups[i] >= count) return failed("a group is not from -1 to below their number");
    bihive::MeasureOptions options;
    options.probe = probe;
    options.threads = threads;
    options.periodic = tree->images.has_value();
    const auto areas =
        bihive::buried_areas(tree->spheres, std::vector<std::int32_t>(groups, groups + tree->spheres.size()), options);
    if (!areas) return failed(areas.error());
    // Groups after the last one that has spheres bury nothing.
    const std::size_t known = areas->alone.size(), all = static_cast<std::size_t>(count);
    std::fill(buried, buried + all * all, 0.0);
    for (std::size_t g = 0; g < known; ++g)
      for (std::size_t h = 0; h < known; ++h)
        buried[g * all + h] = g == h ? areas->alone[g] : areas->buried[g * known + h];
    return kDone;
  });
}
