// A program with bihive::rays alone: a tree, the sphere nearest to a point, and a ray through a periodic cell.
#include <bihive/geometry/sphere_set.h>
#include <bihive/wide/periodic_images.h>
#include <bihive/wide/point_queries.h>
#include <bihive/wide/queries.h>
#include <bihive/wide/surface_of_hit.h>
#include <bihive/wide/wide_builder.h>

#include <cstdio>
#include <vector>

int main() {
  const std::vector<float> x{0, 5}, y{0, 0}, z{0, 0}, r{1, 2};
  const auto spheres = bihive::SphereSet::from_world(x, y, z, r);
  if (!spheres) return std::puts(spheres.error().to_string().c_str()), 1;
  bihive::WideBuilder builder;
  const auto tree = builder.build(*spheres);
  if (!tree) return std::puts(tree.error().to_string().c_str()), 1;
  const double point[] = {3, 0, 0};
  const auto nearest = bihive::nearest_spheres(**tree, bihive::PointSpan::rows(point, 1));
  if (!nearest) return std::puts(nearest.error().to_string().c_str()), 1;
  const bihive::Ray ray{{0, 0, 10}, {0, 0, -1}};
  const bihive::Hit hit = bihive::closest_hit(**tree, ray);
  const auto surface = bihive::surface_of_hit(*spheres, nullptr, ray, hit.t, hit.sphere_id);
  if (!surface) return 1;
  const auto images = bihive::PeriodicImages::of(*spheres);
  if (!images || *images) return std::puts("a set without a cell has images"), 1;
  std::printf("nearest %d, hit %d at z = %g\n", int(nearest->sphere_id[0]), int(hit.sphere_id), surface->position.z);
}
