// The oracle: brute force over all spheres in long double, written without the library's intersection code.
//
// It differs from the library in three ways: it uses the cross product, not the perpendicular form; world units, not
// stored ones; and 64 bits, not 53. It answers two questions: what does the ray hit, and can correct binary64
// arithmetic give a certain answer?
//
// An interval for each root decides the second question. It comes from the error bound of the library's sequence of
// operations that docs/precision.md derives. With u = 2^-53, L the distance from the ray's origin to the centre, D the
// direction's length, p the distance of the line from the centre:
//   |error of t_closest|    <= 8 u L / D
//   |error of discriminant| <= 4 u L p + 6 u p^2 + 2 u r^2 + 130 u^2 L^2
//   half chord: 3 u relative; the sum of both: u relative.
// All are taken 1 % larger, which covers terms of higher order and the oracle's own error (2^-11 of these).
#pragma once

#include <cfloat>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "bihive/geometry/ray.h"
#include "support/world.h"

namespace bihive::test {

static_assert(LDBL_MANT_DIG >= 64, "the oracle needs a long double wider than binary64");

/// One ray and one sphere that it may meet.
struct Encounter {
  std::int64_t id = -1;
  long double t_near = 0, t_far = 0;     ///< exact roots (a tangent line's if only the error bound reaches it)
  long double near_lo = 0, near_hi = 0;  ///< interval of the near root in binary64
  long double far_lo = 0, far_hi = 0;    ///< interval of the far root
  bool exists = false;                   ///< the line meets the sphere
  bool surely_exists = false;            ///< and binary64 cannot miss it
  bool near_counts = true;               ///< false for the sphere from whose surface the ray goes inside
  long double t_error_unit = 0;          ///< u (L + r) / D, the unit of errors
  long double discriminant_share = 0;    ///< discriminant / r^2
};

class Oracle {
 public:
  using Real = long double;
  static constexpr Real kInf = std::numeric_limits<Real>::infinity();

  struct Answer {
    Real t = kInf;
    std::int64_t id = -1;
  };

  explicit Oracle(const World& world) : world_(&world) {}
  const World& world() const { return *world_; }

  /// Every sphere that the ray's line meets, or may meet within the error of binary64.
  std::vector<Encounter> encounters(const Ray& ray) const {
    std::vector<Encounter> list;
    if (!valid(ray)) return list;
    for (std::size_t i = 0; i < world_->size(); ++i)
      if (may_meet(ray, i)) add_encounter(ray, i, list);
    return list;
  }

  /// The nearest hit: for each sphere the near root if it lies in the segment, else the far one; of equal t the smaller
  /// id.
  static Answer closest(const Ray& ray, const std::vector<Encounter>& list) {
    Answer best;
    for (const Encounter& e : list) {
      if (!e.exists) continue;
      Real t = kInf;
      if (in_segment(ray, e.t_far)) t = e.t_far;
      if (e.near_counts && in_segment(ray, e.t_near)) t = e.t_near;
      if (t < best.t) best = {t, e.id};
    }
    return best;
  }

  /// Can binary64 give this answer (id -1: nothing hit)? Ids ascend in the list.
  bool accepts(const Ray& ray, const std::vector<Encounter>& list, double t, std::int64_t id) const {
    if (id < 0) {
      for (const Encounter& e : list)
        if (sure_bound(ray, e) < kInf) return false;
      return id == -1 && t == std::numeric_limits<double>::infinity();
    }
    bool possible = false;
    for (const Encounter& e : list) {
      if (e.id != id) {
        // No other sphere is surely nearer, and no equal sphere with a smaller id could be the answer.
        if (sure_bound(ray, e) < t) return false;
        if (e.id < id && same_sphere(e.id, id)) return false;
        continue;
      }
      const bool is_near = e.near_counts && t >= e.near_lo && t <= e.near_hi;
      const bool is_far = t >= e.far_lo && t <= e.far_hi && !(e.near_counts && surely_in(ray, e, e.near_lo, e.near_hi));
      possible = in_segment(ray, t) && (is_near || is_far);
    }
    return possible;
  }

  /// Can binary64 give this answer to "is anything hit"?
  static bool accepts_any(const Ray& ray, const std::vector<Encounter>& list, bool any) {
    bool possible = false, sure = false;
    for (const Encounter& e : list) {
      sure = sure || sure_bound(ray, e) < kInf;
      possible = possible || (e.near_counts && e.near_hi >= ray.t_min && e.near_lo <= ray.t_max) ||
                 (e.far_hi >= ray.t_min && e.far_lo <= ray.t_max);
    }
    return any ? possible : !sure;
  }

 private:
  static constexpr Real kU = 0x1p-53L;
  static constexpr Real kSlack = 1.01L;

  const World* world_;

  static bool valid(const Ray& ray) {
    const float numbers[6] = {ray.origin.x,    ray.origin.y,    ray.origin.z,
                              ray.direction.x, ray.direction.y, ray.direction.z};
    for (const float number : numbers)
      if (std::isnan(number) || std::isinf(number)) return false;
    if (numbers[3] == 0 && numbers[4] == 0 && numbers[5] == 0) return false;
    return !std::isnan(ray.t_min) && !std::isnan(ray.t_max) && !(ray.t_min > ray.t_max);
  }

  static bool in_segment(const Ray& ray, Real t) { return t >= Real(ray.t_min) && t <= Real(ray.t_max); }
  static bool surely_in(const Ray& ray, const Encounter& e, Real lo, Real hi) {
    return e.surely_exists && lo >= Real(ray.t_min) && hi <= Real(ray.t_max);
  }

  /// An upper bound of the t of the sphere's hit; infinite if there may be no hit.
  static Real sure_bound(const Ray& ray, const Encounter& e) {
    if (e.near_counts && surely_in(ray, e, e.near_lo, e.near_hi)) return e.near_hi;
    if (surely_in(ray, e, e.far_lo, e.far_hi)) return e.far_hi;
    return kInf;
  }

  bool same_sphere(std::int64_t a, std::int64_t b) const {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    const World& w = *world_;
    return w.x[i] == w.x[j] && w.y[i] == w.y[j] && w.z[i] == w.z[j] && w.r[i] == w.r[j];
  }

  /// Does the ray start on the surface of this sphere, or of one equal to it?
  bool leaves(const Ray& ray, std::int64_t id) const {
    return ray.leaves >= 0 && ray.leaves < static_cast<std::int64_t>(world_->size()) && same_sphere(ray.leaves, id);
  }

  /// A quick look in binary64 that only drops spheres whose surface the line misses by more than 1e-8 of their
  /// distance, ten million times the bound above. (Products of four binary32 numbers stay inside binary64's range.)
  bool may_meet(const Ray& ray, std::size_t i) const {
    const World& w = *world_;
    const double x = double(w.x[i]) - double(ray.origin.x), y = double(w.y[i]) - double(ray.origin.y),
                 z = double(w.z[i]) - double(ray.origin.z), r = w.r[i];
    const double dx = ray.direction.x, dy = ray.direction.y, dz = ray.direction.z;
    const double cx = y * dz - z * dy, cy = z * dx - x * dz, cz = x * dy - y * dx;
    const double loose =
        r * r * (1 + 1e-6) + (x * x + y * y + z * z) * 1e-15 + 2e-8 * r * (std::abs(x) + std::abs(y) + std::abs(z));
    return cx * cx + cy * cy + cz * cz <= loose * (dx * dx + dy * dy + dz * dz);
  }

  void add_encounter(const Ray& ray, std::size_t i, std::vector<Encounter>& list) const {
    const World& w = *world_;
    const std::int64_t id = static_cast<std::int64_t>(i);
    const Real r = w.r[i];
    if (!(r > 0) || (leaves(ray, id) && !ray.inside)) return;

    // Intersect: the area of the parallelogram of oc and d gives the line's distance from the centre.
    const Real x = Real(w.x[i]) - ray.origin.x, y = Real(w.y[i]) - ray.origin.y, z = Real(w.z[i]) - ray.origin.z;
    const Real dx = ray.direction.x, dy = ray.direction.y, dz = ray.direction.z;
    const Real cx = y * dz - z * dy, cy = z * dx - x * dz, cz = x * dy - y * dx;
    const Real dd = dx * dx + dy * dy + dz * dz, D = std::sqrt(dd);
    const Real p2 = (cx * cx + cy * cy + cz * cz) / dd, p = std::sqrt(p2);
    const Real L = std::sqrt(x * x + y * y + z * z);
    const Real discriminant = r * r - p2;
    const Real t_closest = (x * dx + y * dy + z * dz) / dd;

    // Bound the errors of binary64.
    const Real slack = kSlack * (4 * kU * L * p + 6 * kU * p2 + 2 * kU * r * r + 130 * kU * kU * L * L);
    if (discriminant + slack < 0) return;
    Encounter e;
    e.id = id;
    e.exists = discriminant >= 0;
    e.surely_exists = discriminant - slack >= 0;
    e.near_counts = !leaves(ray, id);
    e.t_error_unit = kU * (L + r) / D;
    e.discriminant_share = discriminant / (r * r);
    const Real half = std::sqrt(std::max(Real(0), discriminant)) / D;
    e.t_near = t_closest - half;
    e.t_far = t_closest + half;
    const Real half_hi = std::sqrt(discriminant + slack) / D * (1 + 4 * kU);
    const Real half_lo = std::sqrt(std::max(Real(0), discriminant - slack)) / D * (1 - 4 * kU);
    const Real t_slack = kSlack * (8 * kU * L / D + kU * (std::abs(t_closest) + half_hi));
    e.near_lo = t_closest - half_hi - t_slack;
    e.near_hi = t_closest - half_lo + t_slack;
    e.far_lo = t_closest + half_lo - t_slack;
    e.far_hi = t_closest + half_hi + t_slack;
    list.push_back(e);
  }
};

}  // namespace bihive::test
