// Hashes of answers about rays and points, one line for each query: scripts/build_mingw compares them with those of the
// native library.
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <vector>

#include "bihive/geometry/sphere_set.h"
#include "bihive/wide/point_queries.h"
#include "bihive/wide/queries.h"
#include "bihive/wide/wide_builder.h"

namespace {

class Hash {
 public:
  template <class T>
  void add(const std::vector<T>& values) {
    const auto* const bytes = reinterpret_cast<const unsigned char*>(values.data());
    for (std::size_t i = 0; i < values.size() * sizeof(T); ++i) value_ = (value_ ^ bytes[i]) * 1099511628211U;
  }
  void print(const char* name, int spheres) const {
    std::printf("%s of %d spheres: %016llx\n", name, spheres, static_cast<unsigned long long>(value_));
  }

 private:
  std::uint64_t value_ = 14695981039346656037U;
};

float random_number() {
  static std::uint32_t state = 1;
  state = state * 1664525U + 1013904223U;
  return static_cast<float>(state >> 8) * 0x1p-24F;
}

// False: a query failed.
bool print_answers(int count) {
  std::vector<float> x, y, z, r;
  for (int i = 0; i < count; ++i) {
    x.push_back(random_number());
    y.push_back(random_number());
    z.push_back(random_number());
    r.push_back(0.3F * random_number() / static_cast<float>(count / 100 + 1));
  }
  const auto set = bihive::SphereSet::from_world(x, y, z, r);
  if (!set) return false;
  const auto tree = bihive::WideBuilder().build(*set, {}, 2);
  if (!tree) return false;
  bihive::RayBatch rays;
  rays.resize(20000);
  std::vector<double> points;
  for (std::size_t i = 0; i < 20000; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      rays.origin[axis][i] = random_number();
      rays.direction[axis][i] = random_number() - 0.5F;
      points.push_back(double(random_number()));
    }
  for (const bihive::RayOrder order : {bihive::RayOrder::any, bihive::RayOrder::blocks}) {
    const bihive::RayOptions options{order, 2, nullptr, nullptr};
    bihive::HitBatch hits;
    hits.resize(rays.size());
    std::vector<std::uint8_t> hidden(static_cast<std::size_t>(rays.size()));
    std::vector<bihive::RayHit> all;
    if (!bihive::closest_hits(**tree, rays.span(), hits.span(), options) ||
        !bihive::occluded(**tree, rays.span(), hidden.data(), options) ||
        !bihive::all_hits(**tree, rays.span(), all, options))
      return false;
    Hash closest, any, every;
    closest.add(hits.t);
    closest.add(hits.sphere_id);
    any.add(hidden);
    every.add(all);
    closest.print("closest hits", count);
    any.print("occluded", count);
    every.print("all hits", count);
  }
  const auto span = bihive::PointSpan::rows(points.data(), 20000);
  const auto nearest = bihive::nearest_spheres(**tree, span, 5);
  const auto within = bihive::spheres_within(**tree, span, 0.05);
  const auto pairs = bihive::sphere_pairs(**tree, *set, 0.02);
  if (!nearest || !within || !pairs) return false;
  Hash of_nearest, of_within, of_pairs;
  of_nearest.add(nearest->distance);
  of_nearest.add(nearest->sphere_id);
  of_within.add(within->begin);
  of_within.add(within->sphere_id);
  of_within.add(within->distance);
  of_pairs.add(pairs->first);
  of_pairs.add(pairs->second);
  of_pairs.add(pairs->distance);
  of_nearest.print("nearest spheres", count);
  of_within.print("spheres within", count);
  of_pairs.print("pairs", count);
  return true;
}

}  // namespace

int main() {
  for (const int count : {1, 300, 5000})
    if (!print_answers(count)) return 1;
  return 0;
}
