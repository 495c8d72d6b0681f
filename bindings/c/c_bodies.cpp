// Spheres and sticks of bihive.h: rays alone.
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bihive.h"
#include "bihive/render/hit_body.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/scene.h"
#include "c_errors.h"
#include "c_progress.h"
#include "c_ray_chunks.h"
#include "c_spheres.h"
#include "c_tree.h"

// The tracer refers to the scene.
struct bihive_bodies {
  bihive::Scene scene;
  std::optional<bihive::Tracer> tracer;
};

using namespace bihive;     // NOLINT(google-build-using-namespace): the functions below are C's
using namespace bihive::c;  // NOLINT(google-build-using-namespace)

static_assert(static_cast<int>(BodyKind::nothing) == BIHIVE_NOTHING);
static_assert(static_cast<int>(BodyKind::sphere) == BIHIVE_SPHERE);
static_assert(static_cast<int>(BodyKind::stick) == BIHIVE_STICK);

int bihive_bodies_new(const double* xyz, const double* radii, int64_t spheres, const double* ends,
                      const double* end_radii, int64_t sticks, int threads, bihive_bodies** bodies) {
  if (bodies == nullptr) return failed("there is no place for the bodies");
  *bodies = nullptr;
  return guarded_long([&](Work* work) {
    if (spheres < 1) return failed("bodies need at least one sphere");
    if (sticks < 0) return failed("the number of sticks is negative");
    if (xyz == nullptr || radii == nullptr) return failed("the spheres are NULL");
    if (sticks > 0 && (ends == nullptr || end_radii == nullptr)) return failed("the sticks are NULL");
    if (threads < 0) return failed("the number of threads is negative; 0 takes all");
    auto made = std::make_unique<bihive_bodies>();
    auto set = spheres_of(xyz, radii, spheres);
    if (!set) return failed(set.error());
    Scene& scene = made->scene;
    scene.spheres = std::move(*set);
    std::vector<OwnStick> own(static_cast<std::size_t>(sticks));
    for (std::size_t i = 0; i < own.size(); ++i) {
      const double* const of = ends + 6 * i;
      own[i].a = scene.spheres.to_local({of[0], of[1], of[2]});
      own[i].b = scene.spheres.to_local({of[3], of[4], of[5]});
      own[i].radius_a = end_radii[2 * i];
      own[i].radius_b = end_radii[2 * i + 1];
    }
    if (const Status status = scene.sticks.add(scene.spheres, own); !status) return failed(status.error());
    const Section section(work, 0, 1);
    auto tracer = Tracer::build(scene, Engine::automatic, {}, threads);
    if (!tracer) return failed(tracer.error());
    made->tracer.emplace(std::move(*tracer));
    *bodies = made.release();
    return kDone;
  });
}

void bihive_bodies_free(bihive_bodies* bodies) {
  delete bodies;
}

int bihive_bodies_closest(const bihive_bodies* bodies, const bihive_rays* rays, int threads, double* t, uint8_t* kinds,
                          int64_t* ids, double* along) {
  return guarded_query([&] {
    if (bodies == nullptr || !are_ready(rays) || threads < 0)
      return failed("bodies or rays are NULL, or a number is negative");
    if (rays->count > 0 && (t == nullptr || kinds == nullptr || ids == nullptr || along == nullptr))
      return failed("there is no place for the hits");
    const Scene& scene = bodies->scene;
    const HitSpan hits{t, ids};
    return for_chunks(scene.spheres.origin(), *rays, threads,
                      [&](const RaySpan& part, std::int64_t first, std::int64_t) {
                        bodies->tracer->closest_hits(part, RayOrder::any, hits.part(first));
                        for (std::int64_t i = 0; i < part.count; ++i) {
                          const std::int64_t at = first + i;
                          const HitBody body = body_of_hit(scene.spheres, scene.sticks, part.at(i), {t[at], ids[at]});
                          kinds[at] = static_cast<std::uint8_t>(body.kind);
                          ids[at] = body.id;
                          along[at] = body.along;
                        }
                      });
  });
}

int bihive_bodies_occluded(const bihive_bodies* bodies, const bihive_rays* rays, int threads, uint8_t* hidden) {
  return guarded_query([&] {
    if (bodies == nullptr || !are_ready(rays) || threads < 0)
      return failed("bodies or rays are NULL, or a number is negative");
    if (rays->count > 0 && hidden == nullptr) return failed("there is no place for the answers");
    return for_chunks(bodies->scene.spheres.origin(), *rays, threads,
                      [&](const RaySpan& part, std::int64_t first, std::int64_t) {
                        bodies->tracer->occluded(part, RayOrder::any, hidden + first);
                      });
  });
}

int bihive_bodies_all_hits(const bihive_bodies* bodies, const bihive_rays* rays, int threads, bihive_lists** lists) {
  if (lists == nullptr) return failed("there is no place for the lists");
  *lists = nullptr;
  return guarded_query([&] {
    if (bodies == nullptr || !are_ready(rays) || threads < 0)
      return failed("bodies or rays are NULL, or a number is negative");
    struct BodyHit {
      std::int64_t ray;
      double t;
      HitBody body;
    };
    const Scene& scene = bodies->scene;
    std::vector<std::vector<BodyHit>> of_part(static_cast<std::size_t>(Parts::of(rays->count, threads).count));
    const int done = for_chunks(
        scene.spheres.origin(), *rays, threads, [&](const RaySpan& part, std::int64_t first, std::int64_t number) {
          std::vector<RayHit> found;
          bodies->tracer->all_hits(part, RayOrder::any, found);
          std::vector<BodyHit>& hits = of_part[static_cast<std::size_t>(number)];
          hits.reserve(found.size());
          for (const RayHit& hit : found)
            hits.push_back({first + hit.ray, hit.t,
                            body_of_hit(scene.spheres, scene.sticks, part.at(hit.ray), {hit.t, hit.sphere_id})});
        });
    if (done != kDone) return done;
    auto made = std::make_unique<bihive_lists>();
    made->begin.assign(static_cast<std::size_t>(rays->count) + 1, 0);
    for (std::vector<BodyHit>& hits : of_part) {
      stop_if_cancelled();
      for (const BodyHit& hit : hits) {
        ++made->begin[static_cast<std::size_t>(hit.ray) + 1];
        made->spheres.push_back(hit.body.id);
        made->distances.push_back(hit.t);
        made->kinds.push_back(static_cast<std::uint8_t>(hit.body.kind));
        made->along.push_back(hit.body.along);
      }
      std::vector<BodyHit>().swap(hits);
    }
    for (std::size_t i = 1; i < made->begin.size(); ++i) made->begin[i] += made->begin[i - 1];
    *lists = made.release();
    return kDone;
  });
}

const uint8_t* bihive_lists_kinds(const bihive_lists* lists) {
  return lists == nullptr || lists->kinds.size() < lists->spheres.size() ? nullptr : lists->kinds.data();
}

const double* bihive_lists_along(const bihive_lists* lists) {
  return lists == nullptr || lists->along.size() < lists->spheres.size() ? nullptr : lists->along.data();
}
