#include "bihive/spread/proxies.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>

#include "bihive/geometry/cut_sphere.h"
#include "bihive/render/transparency.h"
#include "bihive/scene/camera.h"
#include "bihive/scene/clips.h"
#include "bihive/scene/legend.h"

namespace bihive {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// The first sphere with the greatest value.
struct Greatest {
  double value = -kInfinite;
  std::int64_t id = kNothing;

  void add(double candidate, std::int64_t candidate_id) {
    if (!(candidate > value)) return;
    value = candidate;
    id = candidate_id;
  }
};

// The first of each kind of clear sphere (render/transparency.h asks which kinds there are).
void add_clear(const Scene& scene, std::vector<std::int64_t>& ids) {
  if (!lets_light_through(scene)) return;
  bool known[2][2][2] = {};
  for (std::int64_t id = 0; id < scene.spheres.size(); ++id) {
    const Material material = material_of(scene, id);
    const bool clear = material.transmissive > 0;
    const bool straight = is_passed_straight(material);
    bool& is_known = known[clear ? 1 : 0][straight ? 1 : 0][passing_tint(material) != Vec3d{1, 1, 1} ? 1 : 0];
    if (!is_known) ids.push_back(id);
    is_known = true;
  }
}

// The widest line, and a sphere with the picture's own.
void add_lines(const Scene& scene, std::vector<std::int64_t>& ids) {
  const std::vector<float>& widths = scene.spheres.attributes().outline_px;
  Greatest widest, narrowest;
  for (std::size_t i = 0; i < widths.size(); ++i) {
    widest.add(double(widths[i]), static_cast<std::int64_t>(i));
    narrowest.add(-double(widths[i]), static_cast<std::int64_t>(i));
  }
  ids.insert(ids.end(), {widest.id, narrowest.id});
}

// The nearest and the farthest depth of what clips leave, and a sphere that they cut.
void add_depths_and_cuts(const Scene& scene, const RenderSettings& settings, std::vector<std::int64_t>& ids) {
  const PixelRays rays(local_camera(scene), settings.width_px, settings.height_px);
  const std::shared_ptr<const CutSet> cuts = cut_set_of(scene);
  const Vec3d eye = to_double(rays.eye());
  Greatest nearest, farthest, cut, removed;
  for (std::int64_t id = 0; id < scene.spheres.size(); ++id) {
    const Remainder left = cuts == nullptr ? Remainder::whole : cuts->remainder(id);
    if (left != Remainder::whole) (left == Remainder::cut ? cut : removed).add(1, id);
    if (left == Remainder::nothing) continue;
    const double depth = dot(scene.spheres.local_centre(id) - eye, rays.forward());
    nearest.add(-(depth - scene.spheres.radius(id)), id);
    farthest.add(depth + scene.spheres.radius(id), id);
  }
  ids.insert(ids.end(), {nearest.id, farthest.id, cut.id, removed.id});
}

}  // namespace

std::vector<std::int64_t> proxies_of(const Scene& scene, const RenderSettings& settings) {
  std::vector<std::int64_t> ids{scene.spheres.empty() ? kNothing : 0};
  add_clear(scene, ids);
  add_lines(scene, ids);
  add_depths_and_cuts(scene, settings, ids);
  if (settings.labels.legend) {
    const std::vector<std::int64_t> of_legend = spheres_of_legend(scene);
    ids.insert(ids.end(), of_legend.begin(), of_legend.end());
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  if (!ids.empty() && ids.front() == kNothing) ids.erase(ids.begin());
  return ids;
}

}  // namespace bihive
