// bihive-sticks: rays among the balls and sticks of a molecule, beside Embree's spheres and round linear curves.
//   bihive-sticks INPUT [RAYS] [REPETITIONS]
// One thread; builds and rays of both in turn, medians. Prints one JSON object.
#include <embree3/rtcore.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <vector>

#include "bench_scene.h"
#include "bihive/base/timer.h"
#include "bihive/base/version.h"
#include "bihive/geometry/stick_set.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "bihive/math/quartiles.h"
#include "bihive/math/rng.h"
#include "bihive/render/surface.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/ambient_occlusion.h"
#include "bihive/scene/bonds.h"
#include "bihive/simd/target.h"
#include "peers/embree_rays.h"
#include "tiles.h"

namespace bihive::bench {
namespace {

using nlohmann::ordered_json;

constexpr int kBlock = 8;
constexpr double kStartOfRadius = 1e-3;  // Embree's rays start that much later, as those of bihive-bench

struct Set {
  std::string name;
  bool any_hit = false;
  RayOrder order = RayOrder::any;
  std::vector<Ray> rays;
};

// Embree's scene: geometry 0 has the spheres, geometry 1 the sticks.
class EmbreeBodies {
 public:
  EmbreeBodies(const SphereSet& spheres, const StickSet& sticks, const std::string& target) {
    std::string config = "threads=1";
    if (target == "sse4") config += ",isa=sse4.2";
    if (target == "avx2" || target == "avx512") config += ",isa=" + target;
    device_ = rtcNewDevice(config.c_str());
    if (device_ == nullptr) throw Failure{kEnvironment, {"Embree cannot start", "", 0, 0, ""}};
    const auto add = [](std::vector<float>& to, Vec3d at, double radius) {
      const Vec3f rounded = to_float(at);
      to.insert(to.end(), {rounded.x, rounded.y, rounded.z, static_cast<float>(radius)});
    };
    for (std::int64_t id = 0; id < spheres.size(); ++id) add(points_, spheres.local_centre(id), spheres.radius(id));
    const double world = spheres.inverse_scale();
    for (std::int64_t k = 0; k < sticks.size(); ++k) {
      const Stick stick = sticks.stored(spheres, k);
      add(ends_, world * stick.a, world * stick.radius_a);
      add(ends_, world * stick.b, world * stick.radius_b);
      first_of_stick_.push_back(static_cast<std::uint32_t>(2 * k));
    }
  }
  ~EmbreeBodies() {
    if (scene_ != nullptr) rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreeBodies(const EmbreeBodies&) = delete;
  EmbreeBodies& operator=(const EmbreeBodies&) = delete;

  double build_ms() {
    if (scene_ != nullptr) rtcReleaseScene(scene_);
    const Timer timer;
    scene_ = rtcNewScene(device_);
    const auto attach = [&](RTCGeometryType type, std::vector<float>& vertices, std::vector<std::uint32_t>* indices) {
      const RTCGeometry geometry = rtcNewGeometry(device_, type);
      rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, vertices.data(), 0,
                                 4 * sizeof(float), vertices.size() / 4);
      if (indices != nullptr)
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, indices->data(), 0,
                                   sizeof(std::uint32_t), indices->size());
      rtcCommitGeometry(geometry);
      rtcAttachGeometry(scene_, geometry);
      rtcReleaseGeometry(geometry);
    };
    attach(RTC_GEOMETRY_TYPE_SPHERE_POINT, points_, nullptr);
    attach(RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE, ends_, &first_of_stick_);
    rtcCommitScene(scene_);
    return timer.elapsed_ms();
  }

  RTCScene scene() const { return scene_; }

 private:
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
  std::vector<float> points_, ends_;
  std::vector<std::uint32_t> first_of_stick_;
};

std::vector<Ray> primary_rays(const Scene& scene, int side) {
  const PixelRays pixels(local_camera(scene), side, side);
  std::vector<Ray> rays;
  for (int y = 0; y < side; y += kBlock)
    for (int x = 0; x < side; x += kBlock)
      for (int i = 0; i < kBlock * kBlock; ++i) rays.push_back(pixels.at(x + i % kBlock + 0.5, y + i / kBlock + 0.5));
  return rays;
}

std::vector<Ray> random_rays(const BenchScene& bench, std::int64_t count) {
  SplitMix64 random(7);
  std::vector<Ray> rays;
  while (std::ssize(rays) < count) {
    Vec3d origin, direction;
    for (int axis = 0; axis < 3; ++axis) {
      origin[axis] = bench.random_lo[axis] + (bench.random_hi[axis] - bench.random_lo[axis]) * random.next_double();
      direction[axis] = 2 * random.next_double() - 1;
    }
    const double squared = dot(direction, direction);
    if (squared > 1 || squared < 1e-3) continue;
    Ray ray;
    ray.origin = to_float(origin);
    ray.direction = to_float(normalized(direction));
    rays.push_back(ray);
  }
  return rays;
}

RayBatch batch_of(const std::vector<Ray>& rays) {
  RayBatch batch;
  for (const Ray& ray : rays) batch.push_back(ray);
  return batch;
}

// From the hits of primary rays: to the light, and along eight of the 64 directions of ambient occlusion.
std::vector<Set> sets_of(const BenchScene& bench, const Tracer& tracer, std::int64_t count) {
  const Scene& scene = bench.scene;
  std::vector<Set> sets;
  sets.push_back({"primary", false, RayOrder::blocks, primary_rays(scene, picture_side_px(count))});
  sets.push_back({"random", false, RayOrder::any, random_rays(bench, count)});
  Set shadow{"shadow", true, RayOrder::blocks, {}}, ambient{"ao", true, RayOrder::blocks, {}};
  std::vector<Surface> surfaces;
  for (const Ray& ray : sets[0].rays)
    if (const Hit hit = tracer.closest_hit(ray); hit.found())
      surfaces.push_back(surface_at(scene, ray, {hit.t, hit.sphere_id}));
  for (const Surface& surface : surfaces) {
    const Vec3d to_light = scene.spheres.to_local(scene.lights[0].position) - to_double(surface.origin);
    if (!(dot(surface.normal, to_light) > 0)) continue;
    shadow.rays.push_back(ray_from(surface, to_light, surface.from_inside));
    shadow.rays.back().t_max = 1;
  }
  const DirectionSets directions(64, 1);
  for (std::size_t k = 0; k < 64; k += 8)
    for (const Surface& surface : surfaces)
      if (const Vec3d direction = to_double(directions.of_sample(0)[k]); dot(surface.normal, direction) > 0)
        ambient.rays.push_back(ray_from(surface, direction, surface.from_inside));
  sets.push_back(std::move(shadow));
  sets.push_back(std::move(ambient));
  return sets;
}

double trace_ours_ms(const Tracer& tracer, const Set& set, const RaySpan& rays, HitBatch& hits,
                     std::vector<std::uint8_t>& hidden) {
  constexpr std::int64_t kTile = 131072;
  const Timer timer;
  for (std::int64_t first = 0; first < rays.count; first += kTile) {
    const RaySpan tile = rays.part(first, std::min(kTile, rays.count - first));
    if (set.any_hit)
      tracer.occluded(tile, set.order, hidden.data() + first);
    else
      tracer.closest_hits(tile, set.order, hits.span().part(first));
  }
  return timer.elapsed_ms();
}

ordered_json measure(const Scene& scene, const Tracer& tracer, const EmbreeBodies& embree, const Set& set, int reps) {
  const RayBatch batch = batch_of(set.rays);
  const std::int64_t count = batch.size();
  HitBatch hits;
  hits.resize(count);
  std::vector<std::uint8_t> hidden(static_cast<std::size_t>(count));

  // Embree's best mode, by one pass each.
  std::vector<Ray> started = set.rays;
  for (Ray& ray : started) {
    if (ray.leaves < 0) continue;
    const std::int64_t half = ray.leaves - scene.spheres.total_size();
    const double radius = half < 0 ? scene.spheres.radius(ray.leaves)
                                   : scene.sticks.stored_radius(half / 2) * scene.spheres.inverse_scale();
    ray.t_min = kStartOfRadius * radius / length(to_double(ray.direction));
  }
  std::vector<std::uint32_t> order(set.rays.size());
  std::iota(order.begin(), order.end(), 0U);
  struct Mode {
    double ms = std::numeric_limits<double>::infinity();
    int width = 0;
    bool coherent = false;
    std::unique_ptr<EmbreeRays> rays;
  } best;
  const Tiles all = Tiles::all(count, count);
  for (const int width : {16, 8, 4, 1}) {
    std::unique_ptr<EmbreeRays> rays = make_embree_rays(started, order, set.any_hit, width);
    for (const bool coherent : {false, true}) {
      double ms = rays->trace_ms(embree.scene(), coherent, 1, all);
      ms = std::min(ms, rays->trace_ms(embree.scene(), coherent, 1, all));
      if (ms >= best.ms) continue;
      best.ms = ms;
      best.width = width;
      best.coherent = coherent;
      if (rays) best.rays = std::move(rays);
      if (!coherent) rays = make_embree_rays(started, order, set.any_hit, width);
    }
  }

  // In turn.
  std::vector<double> ours, theirs;
  for (int rep = 0; rep < reps; ++rep) {
    ours.push_back(trace_ours_ms(tracer, set, batch.span(), hits, hidden));
    theirs.push_back(best.rays->trace_ms(embree.scene(), best.coherent, 1, all));
  }
  const std::vector<std::int64_t> answers = best.rays->answers();
  std::int64_t found = 0, on_sticks = 0, different = 0;
  for (std::int64_t i = 0; i < count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const bool is_hit = set.any_hit ? hidden[at] != 0 : hits.at(i).found();
    found += is_hit ? 1 : 0;
    on_sticks += !set.any_hit && hits.at(i).sphere_id >= scene.spheres.total_size() ? 1 : 0;
    different += is_hit != (set.any_hit ? answers[at] != 0 : answers[at] >= 0) ? 1 : 0;
  }
  const auto mray = [count](std::vector<double>& ms) { return static_cast<double>(count) / median(ms) / 1000; };
  const double rate = mray(ours), peer_rate = mray(theirs);
  return {{"rays", count},
          {"mray_per_s", rate},
          {"embree_mray_per_s", peer_rate},
          {"ratio", rate / peer_rate},
          {"embree_width", best.width},
          {"embree_coherent", best.coherent},
          {"hits", found},
          {"on_sticks", on_sticks},
          {"hit_by_one_alone", different}};
}

int run(const std::vector<std::string>& words) {
  if (words.empty() || words.size() > 3) fail_usage("usage: bihive-sticks INPUT [RAYS] [REPETITIONS]");
  BenchOptions options;
  options.input.input = words[0];
  options.rays = words.size() > 1 ? std::atoll(words[1].c_str()) : std::int64_t{1} << 20;
  const int reps = words.size() > 2 ? std::atoi(words[2].c_str()) : 5;
  if (options.rays < 64 || reps < 1) fail_usage("at least 64 rays, and one repetition");
  BenchScene bench = load_bench_scene(options);
  Sticks sticks;
  sticks.bonds = Bonds::automatic;
  sticks.ball_scale = 0.25;
  value_or_fail(scale_balls(bench.scene, sticks));
  value_or_fail(find_bonds(bench.scene, sticks));

  EmbreeBodies embree(bench.scene.spheres, bench.scene.sticks, active_target());
  std::vector<double> ours, theirs;
  for (int rep = 0; rep < reps; ++rep) {
    ours.push_back(value_or_fail(Tracer::build(bench.scene, Engine::wide, {}, 1)).build_ms());
    theirs.push_back(embree.build_ms());
  }
  const Tracer tracer = value_or_fail(Tracer::build(bench.scene, Engine::wide, {}, 1));
  ordered_json json = {{"input", words[0]},
                       {"spheres", bench.scene.spheres.size()},
                       {"sticks", bench.scene.sticks.size()},
                       {"target", active_target()},
                       {"commit", commit()},
                       {"embree", RTC_VERSION_STRING},
                       {"build_ms", median(ours)},
                       {"embree_build_ms", median(theirs)}};
  for (const Set& set : sets_of(bench, tracer, options.rays))
    json["rays"][set.name] = measure(bench.scene, tracer, embree, set, reps);
  print(json.dump(2) + "\n");
  finish_output();
  return kSuccess;
}

}  // namespace
}  // namespace bihive::bench

int main(int argc, char** argv) {
  using namespace bihive;
  try {
    return bench::run({argv + 1, argv + argc});
  } catch (const Failure& failure) {
    say_error(failure.error.to_string());
    return failure.code;
  } catch (const std::exception& error) {
    say_error(error.what());
    return kBadInput;
  }
}
