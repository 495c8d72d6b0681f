#include "bihive/render/transparency.h"

#include <algorithm>
#include <new>
#include <optional>
#include <utility>

#include "bihive/base/memory.h"
#include "bihive/base/watch.h"
#include "bihive/geometry/cut_sphere.h"
#include "bihive/render/query/build_engine.h"
#include "bihive/render/query/empty_engine.h"
#include "bihive/render/query/entries.h"
#include "bihive/render/query/remote_rays.h"
#include "bihive/render/query/stick_engine.h"
#include "bihive/scene/clips.h"
#include "bihive/scene/image_colours.h"

namespace bihive {
namespace {

// The shares of light that a sphere lets straight through.
struct Passing {
  double to_eye, to_light;

  int class_by(OpacityRule rule) const {
    return (rule == OpacityRule::first || rule == OpacityRule::as_one) && to_eye > 0 ? opacity_class(to_eye) : -1;
  }
};
Passing passing_of(const Material& material) {
  const double share = std::min(material.transmissive, 1.0);
  return {is_passed_straight(material) ? share : 0, share};
}

// Spheres and sticks of which a ray takes the same account.
struct Bodies {
  std::vector<std::int64_t> spheres{};  // ids
  std::vector<std::int32_t> sticks{};   // numbers
  std::optional<double> share{};        // that all of them let through; 0: they differ

  bool empty() const { return spheres.empty() && sticks.empty(); }
  void add_sphere(std::int64_t id, double passing) {
    spheres.push_back(id);
    add(passing);
  }
  void add_stick(std::int64_t number, double passing) {
    sticks.push_back(static_cast<std::int32_t>(number));
    add(passing);
  }

 private:
  void add(double passing) {
    if (!share) share = passing;
    if (*share != passing) share = 0;
  }
};

}  // namespace

Vec3d passing_tint(const Material& material) {
  const Vec3d colour = material.colour;
  const double largest = std::max(std::max(colour.x, colour.y), colour.z);
  if (!(largest > 0)) return {1, 1, 1};
  const double stopped = 1 - std::min(material.transmissive, 1.0);
  const auto of = [=](double channel) { return 1 - stopped * (1 - std::max(channel, 0.0) / largest); };
  return {of(colour.x), of(colour.y), of(colour.z)};
}

Result<std::shared_ptr<const TransparentSpheres>> TransparentSpheres::divide(const SphereSet& spheres,
                                                                             std::vector<double> passing, Engine engine,
                                                                             int threads, Properties more) {
  try {
    auto made = std::make_shared<TransparentSpheres>();
    made->passing_ = std::move(passing);
    made->tints_ = std::move(more.tints);
    made->has_tints_ = !made->tints_.empty();
    made->of_images_ = more.of_images;
    made->classes_ = std::move(more.classes);
    made->spheres_ = &spheres;
    made->sticks_ = more.sticks;
    made->cuts_ = more.cuts;
    made->stored_spheres_ = spheres.size();
    made->all_spheres_ = spheres.total_size();
    Bodies opaque, transparent;
    std::vector<Bodies> of_class(kOpacityClasses);
    const auto part_of = [&](std::int64_t id) -> Bodies& {
      const int its_class = made->class_of(id);
      if (!(made->passing(id) > 0)) return opaque;
      return its_class < 0 ? transparent : of_class[static_cast<std::size_t>(its_class)];
    };
    const std::int64_t count = more.first < 0 ? spheres.size() : more.first;
    for (std::int64_t id = 0; id < count; ++id) part_of(id).add_sphere(id, made->passing(id));
    const std::int64_t stick_count = more.sticks != nullptr ? more.sticks->size() : 0;
    for (std::int64_t stick = 0; stick < stick_count; ++stick) {
      const std::int64_t id = made->all_spheres_ + 2 * stick;
      part_of(id).add_stick(stick, made->passing(id));
    }
    made->nothing_is_opaque_ = opaque.empty();
    made->depths_.assign(made->passing_.size() * static_cast<std::size_t>(made->columns()), 0);
    const auto add_depths = [&](std::int64_t id) {
      made->find_depths(id, made->depths_.data() + static_cast<std::int64_t>(made->stored(id)) * made->columns());
    };
    for (const std::int64_t id : transparent.spheres) add_depths(id);
    for (const std::int32_t stick : transparent.sticks)
      for (const std::int64_t half : {0, 1}) add_depths(made->all_spheres_ + 2 * stick + half);
    const auto built = [&](Bodies bodies,
                           const EngineParameters& parameters) -> Result<std::shared_ptr<const RayEngine>> {
      // Many parts, such as those of trails that fade, have sticks alone.
      Result<std::shared_ptr<const RayEngine>> part =
          bodies.spheres.empty() ? Result<std::shared_ptr<const RayEngine>>(std::make_shared<EmptyEngine>())
                                 : build_engine(spheres, std::move(bodies.spheres), more.cuts, parameters);
      if (!part || bodies.sticks.empty()) return part;
      return Result<std::shared_ptr<const RayEngine>>(
          std::make_shared<StickEngine>(spheres, *more.sticks, std::move(bodies.sticks), std::move(*part), more.cuts,
                                        is_of_vectors(parameters.engine)));
    };
    Result<std::shared_ptr<const RayEngine>> part = built(std::move(opaque), {engine, {}, threads});
    if (!part) return part.error();
    made->opaque_ = std::move(*part);
    // Crossings are found by a tree, also for the brute engines.
    const EngineParameters of_tree{is_brute(engine) ? Engine::reference : engine, {}, threads};
    part = built(std::move(transparent), of_tree);
    if (!part) return part.error();
    made->transparent_ = std::move(*part);
    Bodies in_classes;  // the sticks of all classes; with unions all bodies
    for (int number = 0; number < kOpacityClasses; ++number) {
      Bodies& bodies = of_class[static_cast<std::size_t>(number)];
      if (bodies.empty()) continue;
      in_classes.sticks.insert(in_classes.sticks.end(), bodies.sticks.begin(), bodies.sticks.end());
      if (more.as_one) {
        in_classes.spheres.insert(in_classes.spheres.end(), bodies.spheres.begin(), bodies.spheres.end());
        continue;
      }
      Class one{number, nullptr, !bodies.sticks.empty(), bodies.share.value_or(0)};
      if (!bodies.spheres.empty()) {
        bodies.sticks.clear();
        part = built(std::move(bodies), of_tree);
        if (!part) return part.error();
        one.spheres = std::move(*part);
      }
      made->of_classes_.push_back(std::move(one));
    }
    if (!in_classes.empty()) {
      std::sort(in_classes.spheres.begin(), in_classes.spheres.end());
      std::sort(in_classes.sticks.begin(), in_classes.sticks.end());
      part = built(std::move(in_classes), of_tree);
      if (!part) return part.error();
      (more.as_one ? made->unions_ : made->sticks_of_classes_) = std::move(*part);
    }
    return std::shared_ptr<const TransparentSpheres>(std::move(made));
  } catch (const Cancelled&) {
    return cancelled_error();
  } catch (const std::bad_alloc&) {
    return no_memory_for("the transparent spheres");
  }
}

std::shared_ptr<const TransparentSpheres> TransparentSpheres::remote(const Scene& scene, RemoteEngine& remote,
                                                                     bool to_eye, bool has_tints, OpacityRule rule) {
  auto made = std::make_shared<TransparentSpheres>();
  made->seen_ = &scene;
  made->has_classes_ = rule == OpacityRule::first;
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
  const Material material = shown_material(scene, id);
  const bool is_tinted = passing(id) > 0 && (!has_classes_ || passing_of(material).class_by(OpacityRule::first) < 0);
  return is_tinted ? passing_tint(material) : Vec3d{1, 1, 1};
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
  Vec3d share;
  double* const columns_of_share[3] = {&share.x, &share.y, &share.z};
  find_shares(one_ray(ray).span(), RayOrder::any, columns_of_share);
  return has_tints() ? share : Vec3d{share.x, share.x, share.x};
}

// Of a sphere in no class.
void TransparentSpheres::find_depths(std::int64_t id, OpticalDepth* row) const {
  const Vec3d tint = this->tint(id);
  for (int c = 0; c < columns(); ++c) row[c] = optical_depth(passing(id) * tint[c]);
}

// For remote spheres and coloured images, whose transmittance is known only after the hit. Sums the depths of spheres
// without a class; with classes, multiplies `passed` by the share of the first sphere of each class.
void TransparentSpheres::sum_of_hits(const RaySpan& rays, RayOrder order, const DepthSums& sums, double* passed) const {
  static thread_local std::vector<RayHit> found;
  transparent_->all_hits(rays, order, found);
  if (has_classes_) keep_first_of_classes(found);
  sums.clear(rays.count, columns());
  for (std::size_t i = 0; i < found.size();) {
    const std::int64_t ray = found[i].ray;
    double of_class[kOpacityClasses];
    std::fill_n(of_class, kOpacityClasses, 1.0);
    for (; i < found.size() && found[i].ray == ray; ++i) {
      const std::int64_t id = found[i].sphere_id;
      if (const int its_class = class_of(id); its_class >= 0) {
        of_class[its_class] *= passing(id);
        continue;
      }
      OpticalDepth row[3];
      find_depths(id, row);
      sums.add(ray, row, columns());
    }
    if (has_classes_)
      for (const double one : of_class) passed[ray] *= one;
  }
}

void TransparentSpheres::find_sticks_of_classes(const RaySpan& rays, RayOrder order, std::vector<RayHit>& found) const {
  found.clear();
  if (sticks_of_classes_ == nullptr) return;
  sticks_of_classes_->all_hits(rays, order, found);
  keep_first_of_classes(found);
}

void TransparentSpheres::find_first(const Class& one, const RaySpan& rays, RayOrder order,
                                    const std::vector<RayHit>& of_sticks, HitBatch& hits) const {
  hits.resize(rays.count);
  if (one.spheres != nullptr)
    one.spheres->closest_hits(rays, order, hits.span());
  else
    EmptyEngine().closest_hits(rays, order, hits.span());
  if (!one.has_sticks) return;
  for (const RayHit& hit : of_sticks) {
    if (class_of(hit.sphere_id) != one.number) continue;
    const auto i = static_cast<std::size_t>(hit.ray);
    Hit first{hits.t[i], hits.sphere_id[i]};
    first.keep_nearer(hit.t, hit.sphere_id);
    hits.t[i] = first.t;
    hits.sphere_id[i] = first.sphere_id;
  }
}

void TransparentSpheres::find_entries(const RaySpan& rays, RayOrder order, std::vector<RayHit>& entries) const {
  const UnionOfBodies bodies{unions_.get(), spheres_, sticks_, cuts_.get()};
  bodies.find_entries(
      rays, order, [this](std::int64_t id) { return class_of(id); }, entries);
}

void TransparentSpheres::find_shares(const RaySpan& rays, RayOrder order, double* const shares[3]) const {
  // Spheres in no class; where they are remote, all of them.
  const auto count = static_cast<std::size_t>(rays.count);
  static thread_local std::vector<OpticalDepth> depths;
  depths.resize(count * static_cast<std::size_t>(columns()));
  DepthSums sums;
  for (int c = 0; c < columns(); ++c) sums.columns[c] = depths.data() + count * static_cast<std::size_t>(c);
  static thread_local std::vector<double> passed;
  passed.assign(of_classes_.empty() && unions_ == nullptr && !has_classes_ ? 0 : count, 1.0);
  if (seen_ == nullptr && of_images_ == nullptr)
    transparent_->optical_depths(rays, order, {depths_.data(), columns()}, sums);
  else
    sum_of_hits(rays, order, sums, passed.data());
  for (int c = 0; c < columns(); ++c)
    for (std::size_t i = 0; i < count; ++i) shares[c][i] = transmittance(sums.columns[c][i]);

  // The first of each class, or where all let the same through, any.
  static thread_local HitBatch hits;
  static thread_local std::vector<std::uint8_t> crossed;
  static thread_local std::vector<RayHit> entries, of_sticks;
  if (unions_ != nullptr) {
    find_entries(rays, order, entries);
    for (const RayHit& entry : entries) passed[static_cast<std::size_t>(entry.ray)] *= passing(entry.sphere_id);
  }
  find_sticks_of_classes(rays, order, of_sticks);
  for (const Class& one : of_classes_) {
    if (one.share > 0 && !one.has_sticks) {
      crossed.resize(count);
      one.spheres->occluded(rays, order, crossed.data());
      for (std::size_t i = 0; i < count; ++i)
        if (crossed[i] != 0) passed[i] *= one.share;
      continue;
    }
    find_first(one, rays, order, of_sticks, hits);
    for (std::int64_t i = 0; i < rays.count; ++i)
      if (const Hit hit = hits.at(i); hit.found()) passed[static_cast<std::size_t>(i)] *= passing(hit.sphere_id);
  }
  for (int c = 0; c < columns(); ++c)
    for (std::size_t i = 0; i < passed.size(); ++i) shares[c][i] = passed[i] * shares[c][i];
}

int TransparentSpheres::class_of(std::int64_t id) const {
  if (has_classes_) return passing_of(material_of(*seen_, id)).class_by(OpacityRule::first);
  return classes_.empty() ? -1 : classes_[stored(id)];
}

void TransparentSpheres::closest_opaque(const RaySpan& rays, RayOrder order, const HitSpan& hits) const {
  opaque_->closest_hits(rays, order, hits);
}

void TransparentSpheres::hides(const RaySpan& rays, RayOrder order, std::uint8_t* is_occluded) const {
  if (nothing_is_opaque_)
    std::fill_n(is_occluded, rays.count, std::uint8_t{0});
  else
    opaque_->occluded(rays, order, is_occluded);
}

void TransparentSpheres::find_crossings(const RaySpan& rays, RayOrder order, std::vector<RayHit>& found) const {
  transparent_->all_hits(rays, order, found);
  if (has_classes_) keep_first_of_classes(found);
  if (of_classes_.empty() && unions_ == nullptr) return;
  static thread_local HitBatch hits;
  static thread_local std::vector<RayHit> entries, of_sticks;
  if (unions_ != nullptr) {
    find_entries(rays, order, entries);
    found.insert(found.end(), entries.begin(), entries.end());
  }
  find_sticks_of_classes(rays, order, of_sticks);
  for (const Class& one : of_classes_) {
    find_first(one, rays, order, of_sticks, hits);
    for (std::int64_t i = 0; i < rays.count; ++i)
      if (const Hit hit = hits.at(i); hit.found()) found.push_back({i, hit.t, hit.sphere_id});
  }
  sort_hits(found);
}

// Of hits in the order of all_hits(): other processes know the first hits of their own spheres alone.
void TransparentSpheres::keep_first_of_classes(std::vector<RayHit>& found) const {
  std::int64_t ray = -1;
  std::uint32_t crossed = 0;
  const auto is_hidden = [&](const RayHit& hit) {
    if (hit.ray != ray) crossed = 0;
    ray = hit.ray;
    const int its_class = class_of(hit.sphere_id);
    if (its_class < 0) return false;
    const std::uint32_t bit = 1u << its_class;
    const bool again = (crossed & bit) != 0;
    crossed |= bit;
    return again;
  };
  found.erase(std::remove_if(found.begin(), found.end(), is_hidden), found.end());
}

namespace {

// `remote`: where other processes hold the spheres. Then those of the scene say what kinds there are.
Result<Transparency> divided(const Scene& scene, OpacityRule rule, RemoteEngine* remote, Engine engine, int threads,
                             std::int64_t first) {
  Transparency parts;
  if (rule == OpacityRule::each_surface || !lets_light_through(scene)) return parts;
  const std::int64_t spheres = scene.spheres.size();
  const auto count = static_cast<std::size_t>(spheres + 2 * scene.sticks.size());
  std::vector<double> to_eye(count), to_light(count);
  const bool has_classes = rule == OpacityRule::first || rule == OpacityRule::as_one;
  std::vector<std::int8_t> classes(has_classes ? count : 0);
  // Images may have a tint where the stored spheres have none.
  const Scene* const of_images = ImageColours(scene).any() ? &scene : nullptr;
  std::vector<Vec3d> tints;
  bool may_tint = false;
  for (std::size_t i = 0; i < count; ++i) {
    // Of the halves of sticks after the spheres.
    const auto row = static_cast<std::int64_t>(i);
    const Material material = shown_material(scene, row < spheres ? row : row - spheres + scene.spheres.total_size());
    const Passing passing = passing_of(material);
    to_eye[i] = passing.to_eye;
    to_light[i] = passing.to_light;
    const int its_class = passing.class_by(rule);
    if (!classes.empty()) classes[i] = static_cast<std::int8_t>(its_class);
    const bool is_tinted = to_light[i] > 0 && its_class < 0;
    may_tint = may_tint || is_tinted;
    const Vec3d tint = is_tinted ? passing_tint(material) : Vec3d{1, 1, 1};
    if (tints.empty() && tint != Vec3d{1, 1, 1}) tints.assign(count, {1, 1, 1});
    if (!tints.empty()) tints[i] = tint;
  }

  if (of_images != nullptr && may_tint && tints.empty()) tints.assign(count, {1, 1, 1});
  const bool alike = to_eye == to_light;
  const std::shared_ptr<const CutSet> cuts = remote == nullptr ? cut_set_of(scene) : nullptr;
  const auto divide = [&](std::vector<double>& passing,
                          bool is_to_eye) -> Result<std::shared_ptr<const TransparentSpheres>> {
    if (std::none_of(passing.begin(), passing.end(), [](double share) { return share > 0; }))
      return std::shared_ptr<const TransparentSpheres>();
    if (remote != nullptr) return TransparentSpheres::remote(scene, *remote, is_to_eye, !tints.empty(), rule);
    TransparentSpheres::Properties more;
    more.sticks = scene.sticks.empty() ? nullptr : &scene.sticks;
    more.cuts = cuts;
    more.tints = tints;
    more.of_images = may_tint ? of_images : nullptr;
    more.first = first;
    more.classes = classes;
    more.as_one = rule == OpacityRule::as_one;
    return TransparentSpheres::divide(scene.spheres, std::move(passing), engine, threads, std::move(more));
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
