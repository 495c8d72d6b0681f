// Outlines and fog (settings/picture_effects.h) as the header defines them, sample by sample and ray by ray.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "bihive/render/scene_hit.h"
#include "bihive/render/tracer.h"
#include "bihive/render/transparency.h"
#include "bihive/scene/camera.h"
#include "bihive/scene/clips.h"
#include "bihive/scene/render_settings.h"
#include "bihive/scene/scene.h"

namespace bihive::test {

class EffectsReference {
 public:
  /// Scene, tracer and `transparent` (null: no sphere is) must outlive it.
  EffectsReference(const Scene& scene, const Tracer& tracer, const RenderSettings& settings,
                   const TransparentSpheres* transparent = nullptr)
      : scene_(scene),
        tracer_(tracer),
        transparent_(transparent),
        settings_(settings),
        pixels_(scene.camera, settings.width_px, settings.height_px) {
    const RemainingSpheres remaining(scene);
    const SphereSet& spheres = remaining.set();
    for (std::int64_t id = 0; id < spheres.size(); ++id) {
      const double depth = dot(spheres.centre(id) - to_double(pixels_.eye()), pixels_.forward());
      nearest_ = std::min(nearest_, depth - spheres.radius(id));
      farthest_ = std::max(farthest_, depth + spheres.radius(id));
    }
    nearest_ = std::min(std::max(nearest_, 0.0), farthest_);
  }

  /// Of the light through a place of the picture and of the lens.
  Vec3d applied(double x, double y, LensPlace lens, Vec3d light) const {
    const Seen here = seen(x, y, lens);
    if (settings_.outline && here.id >= 0 && is_outlined(x, y, lens, here)) {
      const auto line = static_cast<double>(static_cast<float>(std::min(width_of_line(here), 1.0)));
      const double seen_of_line = line * passing(x, y, lens);
      if (line > 0) light = (1 - seen_of_line) * light + seen_of_line * settings_.outline->colour;
    }
    if (!settings_.fog || here.id == kNothing) return light;
    const Fog& fog = *settings_.fog;
    const double share = farthest_ > nearest_ ? (here.depth - nearest_) / (farthest_ - nearest_) : 0;
    const double grown = std::clamp((share - fog.start) / (fog.end - fog.start), 0.0, 1.0);
    const auto hidden = static_cast<double>(static_cast<float>(fog.strength * grown));
    if (hidden == 0) return light;
    const double seen_of_fog = hidden * passing(x, y, lens);
    return (1 - seen_of_fog) * light + seen_of_fog * scene_.background;
  }

 private:
  // What all transparent spheres before the surface let through.
  double passing(double x, double y, LensPlace lens) const {
    if (transparent_ == nullptr) return 1;
    const Ray ray = pixels_.at(x, y, lens);
    const SceneHit end = scene_hit(scene_, transparent_->closest_opaque(ray), ray);
    std::vector<Crossing> crossings;
    transparent_->find_crossings(ray, crossings);
    double share = 1;
    for (const Crossing& crossing : crossings)
      if (crossing.t < end.t) share = share * transparent_->passing(crossing.id);
    return share;
  }

  struct Seen {
    double depth;
    std::int64_t id;
  };

  Seen seen(double x, double y, LensPlace lens) const {
    const Ray ray = pixels_.at(x, y, lens);
    const SceneHit hit =
        scene_hit(scene_, transparent_ != nullptr ? transparent_->closest_opaque(ray) : tracer_.closest_hit(ray), ray);
    const bool shadows_only = hit.id == kPlane && scene_.plane->shadows_only;
    if (!hit.found() || shadows_only) return {std::numeric_limits<double>::infinity(), kNothing};
    // Both halves of a stick are one thing.
    const std::int64_t half = hit.id - scene_.spheres.total_size();
    return {hit.t * dot(to_double(ray.direction), pixels_.forward()), half >= 0 ? hit.id - half % 2 : hit.id};
  }

  double radius_of(std::int64_t id) const {
    const std::int64_t half = id - scene_.spheres.total_size();
    return half < 0 ? scene_.spheres.radius(id)
                    : scene_.sticks.stored_radius(half / 2) * scene_.spheres.inverse_scale();
  }

  // In pixels.
  double width_of_line(Seen here) const {
    const double pixel = length(pixels_.right()) * (pixels_.parallel() ? 1 : here.depth);
    return std::min(settings_.outline->width_px * line_unit_px(settings_), radius_of(here.id) / (6 * pixel));
  }

  bool is_outlined(double x, double y, LensPlace lens, Seen here) const {
    const double width = std::max(width_of_line(here), 1.0);
    const double limit = here.depth + settings_.outline->step * radius_of(here.id);
    for (int dy = -16; dy <= 16; ++dy)
      for (int dx = -16; dx <= 16; ++dx) {
        if (dx * dx + dy * dy > width * width) continue;
        const Seen there = seen(x + dx, y + dy, lens);
        if (there.id != here.id && there.depth > limit) return true;
      }
    return false;
  }

  const Scene& scene_;
  const Tracer& tracer_;
  const TransparentSpheres* transparent_;
  RenderSettings settings_;
  PixelRays pixels_;
  double nearest_ = std::numeric_limits<double>::infinity(), farthest_ = 0;
};

}  // namespace bihive::test
