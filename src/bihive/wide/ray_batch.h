// Many rays and their hits as structures of arrays. The queries read and write these.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bihive/geometry/hit.h"
#include "bihive/geometry/ray.h"

namespace bihive {

/// A view of `count` rays owned by the caller. Meaning and ranges as in geometry/ray.h; world units. Null: t_min is 0,
/// t_max +inf, leaves kNothing, inside false for every ray.
struct RaySpan {
  std::int64_t count = 0;
  const float* origin[3] = {};
  const float* direction[3] = {};
  const double* t_min = nullptr;
  const double* t_max = nullptr;
  const std::int64_t* leaves = nullptr;
  const std::uint8_t* inside = nullptr;  ///< 0 or 1

  Ray at(std::int64_t i) const {
    Ray ray;
    ray.origin = {origin[0][i], origin[1][i], origin[2][i]};
    ray.direction = {direction[0][i], direction[1][i], direction[2][i]};
    if (t_min != nullptr) ray.t_min = t_min[i];
    if (t_max != nullptr) ray.t_max = t_max[i];
    if (leaves != nullptr) ray.leaves = leaves[i];
    if (inside != nullptr) ray.inside = inside[i] != 0;
    return ray;
  }

  /// Rays first to first + n - 1.
  RaySpan part(std::int64_t first, std::int64_t n) const {
    RaySpan span = *this;
    span.count = n;
    for (int axis = 0; axis < 3; ++axis) {
      span.origin[axis] += first;
      span.direction[axis] += first;
    }
    if (t_min != nullptr) span.t_min += first;
    if (t_max != nullptr) span.t_max += first;
    if (leaves != nullptr) span.leaves += first;
    if (inside != nullptr) span.inside += first;
    return span;
  }
};

/// A view of hits to be written: Hit as two arrays.
struct HitSpan {
  double* t = nullptr;
  std::int64_t* sphere_id = nullptr;

  HitSpan part(std::int64_t first) const { return {t + first, sphere_id + first}; }
};

/// One of several hits of a ray.
struct RayHit {
  std::int64_t ray;  ///< its number in the span
  double t;
  std::int64_t sphere_id;
};

/// Owns its rays. The optional arrays are empty (defaults for all) or have one entry per ray.
struct RayBatch {
  std::vector<float> origin[3];
  std::vector<float> direction[3];
  std::vector<double> t_min, t_max;
  std::vector<std::int64_t> leaves;
  std::vector<std::uint8_t> inside;

  std::int64_t size() const { return static_cast<std::int64_t>(origin[0].size()); }

  /// New rays have origin and direction 0, which hit nothing until written. Optional arrays that have entries get
  /// defaults for them.
  void resize(std::int64_t n) {
    const auto count = static_cast<std::size_t>(n);
    for (int axis = 0; axis < 3; ++axis) {
      origin[axis].resize(count);
      direction[axis].resize(count);
    }
    const Ray plain;
    if (!t_min.empty()) t_min.resize(count, plain.t_min);
    if (!t_max.empty()) t_max.resize(count, plain.t_max);
    if (!leaves.empty()) leaves.resize(count, plain.leaves);
    if (!inside.empty()) inside.resize(count, 0);
  }
  void clear() { resize(0); }

  /// Adds one ray with all its fields. Earlier rays do not change.
  void push_back(const Ray& ray) {
    const Ray plain;
    const auto before = static_cast<std::size_t>(size());
    t_min.resize(before, plain.t_min);
    t_max.resize(before, plain.t_max);
    leaves.resize(before, plain.leaves);
    inside.resize(before, 0);
    for (int axis = 0; axis < 3; ++axis) {
      origin[axis].push_back(ray.origin[axis]);
      direction[axis].push_back(ray.direction[axis]);
    }
    t_min.push_back(ray.t_min);
    t_max.push_back(ray.t_max);
    leaves.push_back(ray.leaves);
    inside.push_back(ray.inside ? 1 : 0);
  }

  /// Adds rays of another batch or array, with all their fields. Earlier rays do not change. An optional array stays
  /// empty if neither side has it.
  void append(const RaySpan& rays) {
    const Ray plain;
    append_optional(t_min, rays.t_min, rays.count, plain.t_min);
    append_optional(t_max, rays.t_max, rays.count, plain.t_max);
    append_optional(leaves, rays.leaves, rays.count, plain.leaves);
    append_optional(inside, rays.inside, rays.count, std::uint8_t{0});
    for (int axis = 0; axis < 3; ++axis) {
      origin[axis].insert(origin[axis].end(), rays.origin[axis], rays.origin[axis] + rays.count);
      direction[axis].insert(direction[axis].end(), rays.direction[axis], rays.direction[axis] + rays.count);
    }
  }

  RaySpan span() const {
    RaySpan view;
    view.count = size();
    for (int axis = 0; axis < 3; ++axis) {
      view.origin[axis] = origin[axis].data();
      view.direction[axis] = direction[axis].data();
    }
    if (!t_min.empty()) view.t_min = t_min.data();
    if (!t_max.empty()) view.t_max = t_max.data();
    if (!leaves.empty()) view.leaves = leaves.data();
    if (!inside.empty()) view.inside = inside.data();
    return view;
  }

 private:
  // `added` may be null. Call it before the origins grow: size() is then the number of earlier rays.
  template <class T>
  void append_optional(std::vector<T>& kept, const T* added, std::int64_t count, T plain) const {
    if (kept.empty() && added == nullptr) return;
    const auto before = static_cast<std::size_t>(size());
    kept.resize(before, plain);
    if (added != nullptr)
      kept.insert(kept.end(), added, added + count);
    else
      kept.resize(before + static_cast<std::size_t>(count), plain);
  }
};

/// Owns its hits.
struct HitBatch {
  std::vector<double> t;
  std::vector<std::int64_t> sphere_id;

  void resize(std::int64_t n) {
    t.resize(static_cast<std::size_t>(n));
    sphere_id.resize(static_cast<std::size_t>(n));
  }
  std::int64_t size() const { return static_cast<std::int64_t>(t.size()); }
  Hit at(std::int64_t i) const { return {t[static_cast<std::size_t>(i)], sphere_id[static_cast<std::size_t>(i)]}; }
  HitSpan span() { return {t.data(), sphere_id.data()}; }
};

}  // namespace bihive
