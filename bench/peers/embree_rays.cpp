#include "peers/embree_rays.h"

#include <xmmintrin.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bihive/base/check.h"
#include "bihive/base/parallel.h"
#include "bihive/base/timer.h"

namespace bihive::bench {
namespace {

// The calls of one packet width, under one name, for a ray with its hit and for a ray alone.
template <int width>
struct Calls;
template <>
struct Calls<1> {
  using RayHit = RTCRayHit;
  using RayOnly = RTCRay;
  static void intersect(const int*, RTCScene scene, RTCIntersectContext* context, RayHit* packet) {
    rtcIntersect1(scene, context, packet);
  }
  static void occluded(const int*, RTCScene scene, RTCIntersectContext* context, RayOnly* packet) {
    rtcOccluded1(scene, context, packet);
  }
};
template <>
struct Calls<4> {
  using RayHit = RTCRayHit4;
  using RayOnly = RTCRay4;
  static constexpr auto* intersect = rtcIntersect4;
  static constexpr auto* occluded = rtcOccluded4;
};
template <>
struct Calls<8> {
  using RayHit = RTCRayHit8;
  using RayOnly = RTCRay8;
  static constexpr auto* intersect = rtcIntersect8;
  static constexpr auto* occluded = rtcOccluded8;
};
template <>
struct Calls<16> {
  using RayHit = RTCRayHit16;
  using RayOnly = RTCRay16;
  static constexpr auto* intersect = rtcIntersect16;
  static constexpr auto* occluded = rtcOccluded16;
};

// One ray's field; it may be a field or an array.
template <class T>
T& lane(T& field, std::int64_t /*i*/) {
  return field;
}
template <class T, std::size_t n>
T& lane(T (&field)[n], std::int64_t i) {
  return field[i];
}

// Numbers below the normal range count as 0, as Embree recommends for speed. The destructor restores the former state.
class FlushToZero {
 public:
  FlushToZero() : before_(_mm_getcsr()) { _mm_setcsr(before_ | kFlushAndDenormalsAreZero); }
  ~FlushToZero() { _mm_setcsr(before_); }
  FlushToZero(const FlushToZero&) = delete;
  FlushToZero& operator=(const FlushToZero&) = delete;

 private:
  static constexpr unsigned kFlushAndDenormalsAreZero = 0x8040;
  unsigned before_;
};

template <int width, bool any_hit>
class PackedRays : public EmbreeRays {
  using Packet = std::conditional_t<any_hit, typename Calls<width>::RayOnly, typename Calls<width>::RayHit>;

 public:
  PackedRays(const std::vector<Ray>& rays, const std::vector<std::uint32_t>& order) : order_(order) {
    const auto count = static_cast<std::int64_t>(rays.size());
    packets_.resize(static_cast<std::size_t>((count + width - 1) / width));
    ends_.resize(packets_.size() * width);
    for (std::int64_t i = 0; i < static_cast<std::int64_t>(ends_.size()); ++i) {
      const Ray& ray = rays[static_cast<std::size_t>(std::min(i, count - 1))];
      auto& fields = ray_of(packets_[static_cast<std::size_t>(i / width)]);
      const std::int64_t l = i % width;
      lane(fields.org_x, l) = ray.origin.x;
      lane(fields.org_y, l) = ray.origin.y;
      lane(fields.org_z, l) = ray.origin.z;
      lane(fields.dir_x, l) = ray.direction.x;
      lane(fields.dir_y, l) = ray.direction.y;
      lane(fields.dir_z, l) = ray.direction.z;
      lane(fields.tnear, l) = static_cast<float>(ray.t_min);
      lane(fields.time, l) = 0;
      lane(fields.mask, l) = ~0U;
      lane(fields.id, l) = 0;
      lane(fields.flags, l) = 0;
      ends_[static_cast<std::size_t>(i)] = static_cast<float>(ray.t_max);
    }
  }

  double trace_ms(RTCScene scene, bool coherent, int threads, const Tiles& tiles) override {
    const Timer timer;
    parallel_for(threads, tiles.count(), [&](std::int64_t i) {
      const Tiles::Range rays = tiles.range(i);
      trace(scene, coherent, rays.begin / width, (rays.end + width - 1) / width);
    });
    return timer.elapsed_ms();
  }

  std::vector<std::int64_t> answers() const override {
    std::vector<std::int64_t> answers(order_.size());
    for (std::size_t i = 0; i < order_.size(); ++i) {
      const Packet& packet = packets_[i / width];
      const auto l = static_cast<std::int64_t>(i % width);
      std::int64_t answer = 0;
      if constexpr (any_hit) {
        answer = std::isinf(lane(packet.tfar, l)) && lane(packet.tfar, l) < 0 ? 1 : 0;
      } else {
        const bool found = lane(packet.hit.geomID, l) != RTC_INVALID_GEOMETRY_ID;
        answer = found ? static_cast<std::int64_t>(lane(packet.hit.primID, l)) : kNothing;
      }
      answers[order_[i]] = answer;
    }
    return answers;
  }

 private:
  static auto& ray_of(Packet& packet) {
    if constexpr (any_hit) {
      return packet;
    } else {
      return packet.ray;
    }
  }

  void trace(RTCScene scene, bool coherent, std::int64_t first_packet, std::int64_t end_packet) {
    const FlushToZero flush;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    alignas(64) int valid[16];
    std::fill(std::begin(valid), std::end(valid), -1);
    const auto rays = static_cast<std::int64_t>(order_.size());
    for (std::int64_t p = first_packet; p < end_packet; ++p) {
      Packet& packet = packets_[static_cast<std::size_t>(p)];
      for (std::int64_t l = 0; l < width; ++l) {
        lane(ray_of(packet).tfar, l) = ends_[static_cast<std::size_t>(p * width + l)];
        if constexpr (!any_hit) lane(packet.hit.geomID, l) = RTC_INVALID_GEOMETRY_ID;
      }
      for (std::int64_t l = rays - p * width; l < width; ++l) valid[l] = 0;
      if constexpr (any_hit) {
        Calls<width>::occluded(valid, scene, &context, &packet);
      } else {
        Calls<width>::intersect(valid, scene, &context, &packet);
      }
    }
  }

  const std::vector<std::uint32_t> order_;
  std::vector<Packet> packets_;
  std::vector<float> ends_;
};

template <int width>
std::unique_ptr<EmbreeRays> packed(const std::vector<Ray>& rays, const std::vector<std::uint32_t>& order,
                                   bool any_hit) {
  if (any_hit) return std::make_unique<PackedRays<width, true>>(rays, order);
  return std::make_unique<PackedRays<width, false>>(rays, order);
}

}  // namespace

std::unique_ptr<EmbreeRays> make_embree_rays(const std::vector<Ray>& rays, const std::vector<std::uint32_t>& order,
                                             bool any_hit, int width) {
  BIHIVE_CHECK(!rays.empty() && rays.size() == order.size());
  switch (width) {
    case 4:
      return packed<4>(rays, order, any_hit);
    case 8:
      return packed<8>(rays, order, any_hit);
    case 16:
      return packed<16>(rays, order, any_hit);
    default:
      return packed<1>(rays, order, any_hit);
  }
}

}  // namespace bihive::bench
