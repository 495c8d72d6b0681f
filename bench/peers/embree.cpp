#include "peers/embree.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "bihive/base/parallel.h"
#include "bihive/base/timer.h"
#include "peers/embree_rays.h"

namespace bihive::bench {
namespace {

// Embree does not know the sphere that a ray exits. So its rays start a little later, by this fraction of the radius.
constexpr double kStartOfRadius = 1e-3;

// Embree calls it before allocations and after deallocations.
bool count_bytes(void* counter, ssize_t bytes, bool /*post*/) {
  static_cast<std::atomic<std::int64_t>*>(counter)->fetch_add(bytes);
  return true;
}

}  // namespace

Result<std::unique_ptr<Embree>> Embree::start(const SphereSet& spheres, int threads, const std::string& target) {
  // Embree's names for instruction sets.
  std::string config = "threads=" + std::to_string(threads);
  if (target == "sse4") config += ",isa=sse4.2";
  if (target == "avx2" || target == "avx512") config += ",isa=" + target;

  std::unique_ptr<Embree> peer(new Embree);
  peer->device_ = rtcNewDevice(config.c_str());
  if (peer->device_ == nullptr) return Error{"Embree cannot start with \"" + config + "\"", "", 0, 0, ""};
  rtcSetDeviceMemoryMonitorFunction(peer->device_, count_bytes, &peer->held_bytes_);
  peer->threads_ = threads;

  // Points in world units: a power of two from the stored ones, so no bit is lost.
  peer->sphere_count_ = spheres.size();
  peer->points_.resize(static_cast<std::size_t>(4 * spheres.size()));
  for (std::int64_t id = 0; id < spheres.size(); ++id) {
    const Vec3f centre = to_float(spheres.local_centre(id));
    const float point[4] = {centre.x, centre.y, centre.z, static_cast<float>(spheres.radius(id))};
    std::copy(point, point + 4, peer->points_.begin() + 4 * id);
  }
  return peer;
}

Embree::~Embree() {
  if (geometry_ != nullptr) rtcReleaseGeometry(geometry_);
  if (scene_ != nullptr) rtcReleaseScene(scene_);
  if (device_ != nullptr) rtcReleaseDevice(device_);
}

std::string Embree::version() {
  return RTC_VERSION_STRING;
}

double Embree::build_fresh_ms() {
  if (geometry_ != nullptr) rtcReleaseGeometry(geometry_);
  if (scene_ != nullptr) rtcReleaseScene(scene_);
  geometry_ = nullptr;
  scene_ = nullptr;
  const std::int64_t before = held_bytes_;
  const Timer timer;
  scene_ = rtcNewScene(device_);
  geometry_ = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_SPHERE_POINT);
  rtcSetSharedGeometryBuffer(geometry_, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, points_.data(), 0,
                             4 * sizeof(float), static_cast<std::size_t>(sphere_count_));
  rtcCommitGeometry(geometry_);
  rtcAttachGeometryByID(scene_, geometry_, 0);
  rtcCommitScene(scene_);
  const double ms = timer.elapsed_ms();
  scene_bytes_ = held_bytes_ - before;
  return ms;
}

double Embree::rebuild_ms() {
  const Timer timer;
  rtcUpdateGeometryBuffer(geometry_, RTC_BUFFER_TYPE_VERTEX, 0);
  rtcCommitGeometry(geometry_);
  rtcCommitScene(scene_);
  return timer.elapsed_ms();
}

float Embree::start_of(const Ray& ray) const {
  if (ray.leaves < 0 || ray.leaves >= sphere_count_) return static_cast<float>(ray.t_min);
  const double radius = double(points_[static_cast<std::size_t>(4 * ray.leaves + 3)]);
  return static_cast<float>(ray.t_min + kStartOfRadius * radius / length(to_double(ray.direction)));
}

std::unique_ptr<EmbreeRays> Embree::prepare(const RaySet& set, int width) const {
  // The rays in the order that suits packets.
  std::vector<Ray> rays;
  rays.reserve(set.packet_order.size());
  const RaySpan span = set.rays.span();
  for (const std::uint32_t i : set.packet_order) {
    rays.push_back(span.at(i));
    rays.back().t_min = double(start_of(rays.back()));
  }
  return make_embree_rays(rays, set.packet_order, set.facts.any_hit, width);
}

std::int64_t Embree::closest(const Ray& ray) const {
  const std::vector<Ray> one{[&] {
    Ray started = ray;
    started.t_min = double(start_of(ray));
    return started;
  }()};
  const std::unique_ptr<EmbreeRays> rays = make_embree_rays(one, {0}, /*any_hit=*/false, 1);
  rays->trace_ms(scene_, /*coherent=*/false, 1, Tiles::all(1, 1));
  return rays->answers()[0];
}

}  // namespace bihive::bench
