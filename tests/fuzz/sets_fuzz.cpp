// Sphere sets of hostile shape: both trees are built and validated, and every engine gives the same bits for rays that
// are as hostile. The input is a recipe: how spheres repeat, shrink and move, then raw numbers.
#include <cmath>

#include "bihive/bih/reference_builder.h"
#include "bihive/bih/validate.h"
#include "bihive/wide/wide_builder.h"
#include "bihive/wide/wide_validate.h"
#include "engines.h"

namespace {

using namespace bihive;
using fuzz::Bytes;
using fuzz::demand;

// Any finite number within binary32, often one that other spheres have too.
double coordinate(Bytes& bytes, std::vector<double>& seen) {
  const auto kind = bytes.take<std::uint8_t>();
  double value = 0;
  if (kind < 96 && !seen.empty()) {
    value = seen[kind % seen.size()];
    if (kind >= 64) value = double(std::nextafter(static_cast<float>(value), kind & 1 ? 1e38F : -1e38F));
  } else if (kind < 160) {
    value = std::ldexp(bytes.take<std::int8_t>(), kind % 16 - 8);
  } else if (kind < 224) {
    value = std::ldexp(double(bytes.take<std::int16_t>()), bytes.take<std::int8_t>() % 100);
  } else {
    value = double(bytes.take<float>());
  }
  if (!(std::abs(value) <= 3.4e38)) value = 0;
  if (seen.size() < 256) seen.push_back(value);
  return value;
}

Ray ray_from(Bytes& bytes, const SphereSet& spheres, std::vector<double>& seen) {
  Ray ray;
  const auto kind = bytes.take<std::uint8_t>();
  const Vec3d origin{coordinate(bytes, seen), coordinate(bytes, seen), coordinate(bytes, seen)};
  Vec3d direction{coordinate(bytes, seen), coordinate(bytes, seen), coordinate(bytes, seen)};
  const std::int64_t aim = spheres.empty() ? 0 : bytes.take<std::uint8_t>() % spheres.size();
  if ((kind & 3) == 1 && !spheres.empty()) direction = spheres.centre(aim) - origin;
  if ((kind & 3) == 2 && !spheres.empty()) direction = spheres.centre(aim) + Vec3d{spheres.radius(aim), 0, 0} - origin;
  ray.origin = to_float(origin);
  ray.direction = to_float(direction);
  if (kind & 16) {
    ray.t_min = coordinate(bytes, seen);
    ray.t_max = coordinate(bytes, seen);
  }
  if ((kind & 32) && !spheres.empty()) {
    ray.leaves = aim;
    ray.inside = (kind & 64) != 0;
  }
  return ray;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const auto repeats = 1 + bytes.take<std::uint8_t>() % 40, spheres_wanted = 1 + bytes.take<std::uint8_t>() % 64;
  const auto rays_wanted = 1 + bytes.take<std::uint8_t>() % 100;
  const auto prims = bytes.take<std::uint8_t>() % 20, depth = bytes.take<std::uint8_t>() % 40;
  const auto how = bytes.take<std::uint8_t>();

  // Each place is repeated: at the same place, along a line, or shrinking by powers of two.
  std::vector<double> seen, x, y, z, r;
  for (int i = 0; i < spheres_wanted && !bytes.at_end(); ++i) {
    const Vec3d centre{coordinate(bytes, seen), coordinate(bytes, seen), coordinate(bytes, seen)};
    const double radius = std::abs(coordinate(bytes, seen));
    for (int k = 0; k < (i % 4 == 0 ? repeats : 1); ++k) {
      const double factor = (how & 3) == 1 ? std::ldexp(1, -k) : (how & 3) == 2 ? 1 + k * 0x1p-20 : 1;
      x.push_back(centre.x * factor);
      y.push_back(centre.y * factor);
      z.push_back(centre.z * factor);
      r.push_back((how & 4) ? radius * factor : radius);
    }
  }
  for (auto* values : {&x, &y, &z, &r})
    for (double& value : *values) value = std::abs(value) <= 3.4e38 ? value : 0;
  const Result<SphereSet> made = SphereSet::from_world(x, y, z, r);
  demand(made.ok());
  const SphereSet& spheres = *made;

  // Both trees are right.
  TreeParameters parameters;
  if (prims > 0) parameters.max_prims = prims;
  if (depth > 0) parameters.max_depth = depth;
  const Tree tree = build_reference_tree(spheres, parameters.for_reference());
  demand(validate_tree(tree, spheres).ok());
  WideBuilder builder;
  const auto wide = builder.build(spheres, parameters.for_wide(spheres.size()), 1);
  demand(wide.ok() && validate_wide_tree(**wide, spheres).ok());

  // All engines agree.
  RayBatch rays;
  for (int i = 0; i < rays_wanted; ++i) rays.push_back(ray_from(bytes, spheres, seen));
  const Tracer brute = *Tracer::build(spheres, Engine::brute, parameters, 1);
  const fuzz::Answers expected = fuzz::answers_of(brute, rays, RayOrder::any);
  const Tracer reference(spheres, std::make_shared<const Tree>(tree));
  demand(fuzz::answers_of(reference, rays, RayOrder::any) == expected);
  const Tracer fast(spheres, *wide);
  for (const RayOrder order : {RayOrder::any, RayOrder::blocks})
    demand(fuzz::answers_of(fast, rays, order) == expected);
  for (std::int64_t i = 0; i < rays.span().count; ++i) {
    const Hit hit = fast.closest_hit(rays.span().at(i));
    demand(std::memcmp(&hit.t, &expected.t[std::size_t(i)], sizeof hit.t) == 0 &&
           hit.sphere_id == expected.id[std::size_t(i)]);
    demand(fast.occluded(rays.span().at(i)) == (expected.hidden[std::size_t(i)] != 0));
  }
  return 0;
}
