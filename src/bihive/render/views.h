// The views that do not show light: their colours stand for numbers. Display values; the transfer curve is not applied.
#pragma once

#include <cstdint>

#include "bihive/math/vec3.h"
#include "bihive/render/scene_hit.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/scene.h"

namespace bihive {

class CutSet;

/// 1 red, 2 green, 3 blue, 4 yellow, 5 magenta, deeper white, 0 black (the colours of the thesis's Figure 4.2f).
Vec3d recursion_colour(int deepest_hit);

/// Green + 0.2 for each gap passed, blue + 0.2 for each inner node or leaf entered (Figure 4.3); up to 1. The plane is
/// ignored. The tracer must have a tree.
Vec3d traversal_colour(const Tracer& tracer, const Ray& ray);

/// (n + 1) / 2 of the normal turned against the ray; black for a miss.
/// `cuts` as surface_at().
Vec3d normal_colour(const Scene& scene, const Ray& ray, const SceneHit& hit, const CutSet* cuts = nullptr);

/// A fixed hash of the id, never close to black; black for a miss.
Vec3d id_colour(std::int64_t id);

/// The distances between which the distance view runs from white to black.
struct DistanceRange {
  double nearest, farthest;
};

/// In world units, along the ray.
double distance_of(const Ray& ray, const SceneHit& hit);

/// White at the nearest distance, black at the farthest and for a miss. A single distance is white.
Vec3d distance_colour(const Ray& ray, const SceneHit& hit, const DistanceRange& range);

}  // namespace bihive
