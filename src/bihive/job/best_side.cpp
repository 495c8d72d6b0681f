#include "bihive/job/best_side.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "bihive/job/failure.h"
#include "bihive/math/elementary.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/principal_side.h"

namespace bihive {
namespace {

constexpr int kSidePx = 64;
constexpr double kGoldenAngleDeg = 137.50776405003785;

// Points of a spiral whose turns are as far apart as its points.
Vec3d compared_direction(int i) {
  const double z = 1 - (2.0 * i + 1) / kComparedSides;
  const double turns = i * kGoldenAngleDeg / 360;
  const SineCosine angle = sine_cosine_deg(360 * (turns - std::floor(turns)));
  const double across = std::sqrt(1 - z * z);
  return {across * angle.cosine, across * angle.sine, z};
}

// The distance from a point to the end of the farthest of these spheres.
double reach_from(const SphereSet& spheres, Vec3d point) {
  double reach = 0;
  for (std::int64_t id = 0; id < spheres.total_size(); ++id)
    reach = std::max(reach, length(spheres.centre(id) - point) + spheres.radius(id));
  return reach;
}

}  // namespace

Side best_side(const Scene& scene, const std::vector<std::int64_t>& ids, int threads) {
  const SphereSet& spheres = scene.spheres;
  const SphereSet selected = spheres.part(ids);
  const Vec3d middle = middle_of(selected.bounds());
  std::vector<std::uint8_t> is_selected(static_cast<std::size_t>(spheres.size()), 0);
  for (const std::int64_t id : ids) is_selected[static_cast<std::size_t>(id)] = 1;

  Camera camera;
  camera.projection = Projection::orthographic;
  camera.look_at = middle;
  camera.shorter_side = 2 * reach_from(selected, middle);
  if (!(camera.shorter_side > 0)) return side_of(ViewFrom::front);
  // Origins are rounded to binary32, and must not come to lie in a sphere.
  const double distance = 1.001 * reach_from(spheres, middle);

  const Tracer tracer = value_or_fail(Tracer::build(scene, Engine::automatic, {}, threads));
  const Tile all{0, 0, kSidePx, kSidePx};
  std::vector<double> t(std::size_t{kSidePx} * kSidePx);
  std::vector<std::int64_t> hit(t.size());
  std::int64_t most = 0;
  Side best{};
  for (int i = 0; i < kComparedSides; ++i) {
    const Side side = upright_side(compared_direction(i));
    camera.eye = middle + distance * side.back;
    camera.up = side.up;
    tracer.closest_hits(PixelRays(relative_to(camera, spheres.origin()), kSidePx, kSidePx), all,
                        {t.data(), hit.data()});
    const std::int64_t seen = std::count_if(hit.begin(), hit.end(), [&](std::int64_t id) {
      return id >= 0 && is_selected[static_cast<std::size_t>(spheres.stored_id(id))] != 0;
    });
    if (seen <= most) continue;
    most = seen;
    best = side;
  }
  if (most == 0)
    fail_setting("view_from", ": no direction shows any sphere of the selection", "hide or cut away what covers them");
  return best;
}

}  // namespace bihive
