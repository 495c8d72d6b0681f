#include "bihive/render/transparency.h"

#include <algorithm>
#include <new>
#include <utility>

#include "bihive/base/memory.h"
#include "bihive/geometry/cut_sphere.h"
#include "bihive/render/query/build_engine.h"
#include "bihive/render/query/remote_rays.h"
#include "bihive/scene/clips.h"
#include "bihive/scene/image_colours.h"

namespace bihive {
namespace {

// The shares of light that a sphere lets straight through.
struct Passing {
  double to_eye, to_light;
};
Passing passing_of(const Material& material) {
  const double share = std::min(material.transmissive, 1.0);
  return {is_passed_straight(material) ? share : 0, share};
}

}  // namespace

Vec3d passing_tint(const Material& material) {
  const Vec3d colour = material.colour;
  const double largest = std::max(std::max(colour.x, colour.y), colour.z);
  if (!(largest > 0)) return {1, 1, 1};
  const double stopped = 1 - std::min(material.transmissive, 1.0);
  const auto of = [=](double channel) { return 1 - stopped * (1 - std::max(channel, 0.0) / largest); };
  return {of(colour.x), of(colour.y), of(colour.z)};
}

Result<std::shared_ptr<const TransparentSpheres>> TransparentSpheres::divide(
    const SphereSet& spheres, std::vector<double> passing, Engine engine, int threads,
    std::shared_ptr<const CutSet> cuts, std::vector<Vec3d> tints, const Scene* of_images, std::int64_t first) {
  try {
    auto made = std::make_shared<TransparentSpheres>();
    made->passing_ = std::move(passing);
    made->tints_ = std::move(tints);
    made->has_tints_ = !made->tints_.empty();
    made->of_images_ = of_images;
    std::vector<std::int64_t> opaque, transparent;
    const std::int64_t count = first < 0 ? spheres.size() : first;
    for (std::int64_t id = 0; id < count; ++id) (made->passing(id) > 0 ? transparent : opaque).push_back(id);
    Result<std::shared_ptr<const RayEngine>> part =
        build_engine(spheres, std::move(opaque), cuts, {engine, {}, threads});
    if (!part) return part.error();
    made->opaque_ = std::move(*part);
    // Crossings are found by a tree, also for the brute engines.
    part = build_engine(spheres, std::move(transparent), std::move(cuts),
                        {is_brute(engine) ? Engine::reference : engine, {}, threads});
    if (!part) return part.error();
    made->transparent_ = std::move(*part);
    return std::shared_ptr<const TransparentSpheres>(std::move(made));
  } catch (const std::bad_alloc&) {
    return no_memory_for("the transparent spheres");
  }
}

std::shared_ptr<const TransparentSpheres> TransparentSpheres::remote(const Scene& scene, RemoteEngine& remote,
                                                                     bool to_eye, bool has_tints) {
  auto made = std::make_shared<TransparentSpheres>();
  made->seen_ = &scene;
  made->to_eye_ = to_eye;
  made->has_tints_ = has_tints;
  made->opaque_ =
      std::make_shared<RemoteRays>(&remote, to_eye ? WhichSpheres::opaque_to_eye : WhichSpheres::opaque_to_light);
  made->transparent_ =
      std::make_shared<RemoteRays>(&remote, to_eye ? WhichSpheres::clear_to_eye : WhichSpheres::clear_to_light);
  return made;
}

double TransparentSpheres::passing_of_seen(std::int64_t id) const {
  const Passing passing = passing_of(material_of(*seen_, id));
  return to_eye_ ? passing.to_eye : passing.to_light;
}

Vec3d TransparentSpheres::tint_of(const Scene& scene, std::int64_t id) const {
  return passing(id) > 0 ? passing_tint(material_of(scene, id)) : Vec3d{1, 1, 1};
}

Hit TransparentSpheres::closest_opaque(const Ray& ray) const {
  return opaque_->closest_hit(ray);
}

void TransparentSpheres::find_crossings(const Ray& ray, std::vector<Crossing>& found) const {
  static thread_local std::vector<RayHit> hits;
  find_crossings(one_ray(ray).span(), RayOrder::any, hits);
  found.clear();
  for (const RayHit& hit : hits) found.push_back({hit.t, hit.sphere_id});
}

Vec3d TransparentSpheres::share(const Ray& ray) const {
  if (opaque_->occluded(ray)) return {};
  static thread_local std::vector<Crossing> crossings;
  find_crossings(ray, crossings);
  double share = 1;
  Vec3d tint_of_all{1, 1, 1};
  for (const Crossing& crossing : crossings) {
    share = share * passing(crossing.id);
    tint_of_all = tint_of_all * tint(crossing.id);
  }
  return share * tint_of_all;
}

void TransparentSpheres::closest_opaque(const RaySpan& rays, RayOrder order, const HitSpan& hits) const {
  opaque_->closest_hits(rays, order, hits);
}

void TransparentSpheres::hides(const RaySpan& rays, RayOrder order, std::uint8_t* is_occluded) const {
  opaque_->occluded(rays, order, is_occluded);
}

void TransparentSpheres::find_crossings(const RaySpan& rays, RayOrder order, std::vector<RayHit>& found) const {
  transparent_->all_hits(rays, order, found);
}

namespace {

// `remote`: where other processes hold the spheres. Then those of the scene say what kinds there are.
Result<Transparency> divided(const Scene& scene, OpacityRule rule, RemoteEngine* remote, Engine engine, int threads,
                             std::int64_t first) {
  Transparency parts;
  if (rule == OpacityRule::each_surface || !lets_light_through(scene)) return parts;
  const auto count = static_cast<std::size_t>(scene.spheres.size());
  std::vector<double> to_eye(count), to_light(count);
  // Images may have a tint where the stored spheres have none.
  const Scene* const of_images = ImageColours(scene).any() ? &scene : nullptr;
  std::vector<Vec3d> tints;
  if (of_images != nullptr) tints.assign(count, {1, 1, 1});
  for (std::size_t i = 0; i < count; ++i) {
    const Material material = material_of(scene, static_cast<std::int64_t>(i));
    const Passing passing = passing_of(material);
    to_eye[i] = passing.to_eye;
    to_light[i] = passing.to_light;
    const Vec3d tint = to_light[i] > 0 ? passing_tint(material) : Vec3d{1, 1, 1};
    if (tints.empty() && tint != Vec3d{1, 1, 1}) tints.assign(count, {1, 1, 1});
    if (!tints.empty()) tints[i] = tint;
  }

  const bool alike = to_eye == to_light;
  const std::shared_ptr<const CutSet> cuts = remote == nullptr ? cut_set_of(scene) : nullptr;
  const auto divide = [&](std::vector<double>& passing,
                          bool is_to_eye) -> Result<std::shared_ptr<const TransparentSpheres>> {
    if (std::none_of(passing.begin(), passing.end(), [](double share) { return share > 0; }))
      return std::shared_ptr<const TransparentSpheres>();
    if (remote != nullptr) return TransparentSpheres::remote(scene, *remote, is_to_eye, !tints.empty());
    return TransparentSpheres::divide(scene.spheres, std::move(passing), engine, threads, cuts, tints, of_images,
                                      first);
  };
  Result<std::shared_ptr<const TransparentSpheres>> part = divide(to_light, alike);
  if (!part) return part.error();
  parts.to_light = *part;
  if (!alike) part = divide(to_eye, true);
  if (!part) return part.error();
  parts.to_eye = std::move(*part);
  return parts;
}

}  // namespace

Result<Transparency> Transparency::of(const Scene& scene, OpacityRule rule, const Tracer& tracer, int threads) {
  return divided(scene, rule, tracer.remote(), tracer.engine(), threads, -1);
}

Result<Transparency> Transparency::of(const Scene& scene, OpacityRule rule, Engine engine, int threads,
                                      std::int64_t first) {
  return divided(scene, rule, nullptr, engine, threads, first);
}

}  // namespace bihive
