#include "bihive/render/shade/wave/wave_integrator.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "bihive/geometry/plane.h"
#include "bihive/settings/opacity_rule.h"

namespace bihive {
namespace {

constexpr std::int64_t kRaysBetweenLooks = 64;
// Hits and shadows are queries for a whole generation. The steps between them take as many rays at a time as fit the
// nearest cache. A part ends between two owners: without shadows, the surfaces of one part are added before the misses
// of the next part.
constexpr std::int64_t kRaysShadedAtOnce = 512;

// Rays whose layers are stored layer after layer, so that rays from neighbouring surfaces fill whole beams.
constexpr std::int64_t kRaysOfLayer = 2048;

// Rays about which other processes are asked before their turn comes.
constexpr std::int64_t kMostRaysAskedAhead = 1 << 17;

RayOrder order_of(const WavePart& rays) {
  return rays.wave->starts_at_eye ? RayOrder::blocks : RayOrder::any;
}

// The end of a part of a wave from `first` on, before `last`: after `most` rays, or a few more until the last owner's
// rays end.
std::int64_t end_of_part(const Wave& wave, std::int64_t first, std::int64_t last, std::int64_t most) {
  std::int64_t end = std::min(last, first + most);
  if (!wave.starts_at_eye)
    while (end < last && wave.owner[end] == wave.owner[end - 1]) ++end;
  return end;
}

}  // namespace

void WaveIntegrator::trace(WaveBuffers& buffers, std::int64_t owners, std::int64_t first_sample,
                           const PixelPlace* pixel) {
  pixel_ = pixel;
  first_sample_ = first_sample;
  buffers.generations.resize(std::max<std::size_t>(buffers.generations.size(), std::size_t(settings_.recursion)));
  buffers.sums.reset(owners);
  buffers.crossings.resize(std::max(buffers.crossings.size(), buffers.generations.size()));
  if (settings_.depth) deepest_hit_.assign(static_cast<std::size_t>(owners), 0);
  passing_.clear();
  coverage_.clear();
  if (covers_by_shadows()) coverage_.assign(static_cast<std::size_t>(owners), kUncovered);
  Wave& first = primaries(buffers);
  rays_.primary += first.count;
  trace_part({&first, 0, first.count}, 1, buffers);
}

void WaveIntegrator::find_first_hits(WaveBuffers& buffers) {
  Wave& first = primaries(buffers);
  rays_.primary += first.count;
  find_sphere_hits({&first, 0, first.count}, buffers);
  steps::hit_plane(scene_, {&first, 0, first.count}, buffers.t.data(), buffers.id.data());
}

// Calls ask(some, first) for all rays. Scalar engines gain nothing from long spans, and a cancel should take effect
// soon.
template <class Ask>
void WaveIntegrator::for_each_span(const RaySpan& rays, const Ask& ask) const {
  const std::int64_t step = tracer_.engine() == Engine::wide ? rays.count : kRaysBetweenLooks;
  for (std::int64_t i = 0; i < rays.count && !cancelled(); i += step)
    ask(rays.part(i, std::min(step, rays.count - i)), i);
}

void WaveIntegrator::find_sphere_hits(const WavePart& rays, WaveBuffers& buffers) const {
  buffers.t.reserve(rays.count());
  buffers.id.reserve(rays.count());
  const RayOrder order = order_of(rays);
  for_each_span(rays.span(), [&](const RaySpan& some, std::int64_t first) {
    const HitSpan hits = HitSpan{buffers.t.data(), buffers.id.data()}.part(first);
    if (to_eye() != nullptr)
      to_eye()->closest_opaque(some, order, hits);
    else
      tracer_.closest_hits(some, order, hits);
  });
}

void WaveIntegrator::trace_part(const WavePart& rays, int depth, WaveBuffers& buffers) {
  find_sphere_hits(rays, buffers);
  if (cancelled()) return;
  if (to_eye() != nullptr && find_crossings(rays, depth, buffers)) return trace_layers(rays, depth, buffers);
  follow(rays, depth, buffers);
}

// Which transparent spheres do the rays cross before they end? False: none.
bool WaveIntegrator::find_crossings(const WavePart& rays, int depth, WaveBuffers& buffers) const {
  // The plane may end a ray too.
  steps::hit_plane(scene_, rays, buffers.t.data(), buffers.id.data());
  CrossingBuffers& found = buffers.crossings[static_cast<std::size_t>(depth - 1)];
  const auto count = static_cast<std::size_t>(rays.count());
  RaySpan span = rays.span();
  span.t_max = buffers.t.data();
  to_eye()->find_crossings(span, order_of(rays), found.crossings);
  if (found.crossings.empty()) return false;

  found.end.assign(buffers.t.data(), buffers.t.data() + count);
  found.end_id.assign(buffers.id.data(), buffers.id.data() + count);
  const auto at_end = [&](const RayHit& hit) { return !(hit.t < found.end[static_cast<std::size_t>(hit.ray)]); };
  found.crossings.erase(std::remove_if(found.crossings.begin(), found.crossings.end(), at_end), found.crossings.end());
  found.first.assign(count + 1, 0);
  for (const RayHit& hit : found.crossings) ++found.first[static_cast<std::size_t>(hit.ray) + 1];
  for (std::size_t i = 0; i < count; ++i) found.first[i + 1] += found.first[i];
  return true;
}

// Follows a ray for each surface that the rays meet: some rays at a time, cut between owners, so that the number of
// layers does not matter.
void WaveIntegrator::trace_layers(const WavePart& rays, int depth, WaveBuffers& buffers) {
  const CrossingBuffers& found = buffers.crossings[static_cast<std::size_t>(depth - 1)];
  // An owner may receive light several times.
  if (buffers.sums.empty) {
    for (int channel = 0; channel < 3; ++channel) std::fill_n(buffers.sums.light[channel].data(), rays.count(), 0.0);
    buffers.sums.empty = false;
    passing_.assign(static_cast<std::size_t>(rays.count()), 1.0);
    if (settings_.without_background && coverage_.empty())
      coverage_.assign(static_cast<std::size_t>(rays.count()), 1.0);
  }
  const auto owner = [&](std::int64_t i) {
    return rays.wave->starts_at_eye ? rays.first + i : rays.wave->owner[rays.first + i];
  };
  const auto surfaces = [&](std::int64_t first, std::int64_t end) {
    const std::size_t crossings =
        found.first[static_cast<std::size_t>(end)] - found.first[static_cast<std::size_t>(first)];
    return static_cast<std::int64_t>(crossings) + end - first;
  };
  for (std::int64_t first = 0; first < rays.count() && !cancelled();) {
    std::int64_t end = first;
    for (std::int64_t next = first + 1; next <= rays.count(); ++next) {
      if (next < rays.count() && owner(next) == owner(next - 1)) continue;
      if (end > first && surfaces(first, next) > kMostRaysAtOnce) break;
      end = next;
    }
    put_layers(rays, found, first, end, depth, buffers);
    follow({&buffers.layers, 0, buffers.layers.count}, depth, buffers);
    first = end;
  }
}

// The rays of number `first` to before `end` as a wave with a ray for each surface, and their hits.
void WaveIntegrator::put_layers(const WavePart& rays, const CrossingBuffers& found, std::int64_t first,
                                std::int64_t end, int depth, WaveBuffers& buffers) {
  const auto most = static_cast<std::int64_t>(found.first[static_cast<std::size_t>(end)] -
                                              found.first[static_cast<std::size_t>(first)]) +
                    end - first;
  buffers.layers.reset(most, to_eye()->has_tints());
  buffers.t.reserve(most);
  buffers.id.reserve(most);
  const std::int64_t at_once = layers_go_together() ? kRaysOfLayer : 1;
  for (std::int64_t k = first; k < end; k += at_once)
    put_layers_together(rays, found, k, std::min(end, k + at_once), depth, buffers);
}

// One layer of all these rays after the other.
void WaveIntegrator::put_layers_together(const WavePart& rays, const CrossingBuffers& found, std::int64_t first,
                                         std::int64_t end, int depth, WaveBuffers& buffers) {
  const Wave& wave = *rays.wave;
  Wave& layers = buffers.layers;
  struct Left {
    std::int64_t ray;
    std::size_t next;  // of its crossings
    double weight;
    Vec3d tint;
  };
  static thread_local std::vector<Left> left;
  left.clear();
  for (std::int64_t k = first; k < end; ++k) {
    const std::int64_t from = rays.first + k;
    Left ray{k, found.first[static_cast<std::size_t>(k)], wave.starts_at_eye ? 1 : wave.weight[from], {1, 1, 1}};
    for (int channel = 0; wave.has_tints && channel < 3; ++channel) ray.tint[channel] = wave.tint[channel][from];
    left.push_back(ray);
  }

  while (!left.empty()) {
    std::size_t kept = 0;
    for (Left& ray : left) {
      const std::int64_t from = rays.first + ray.ray;
      const auto k = static_cast<std::size_t>(ray.ray);
      const auto add = [&](double t, std::int64_t id) {
        const std::int64_t to = layers.count++;
        for (int axis = 0; axis < 3; ++axis) {
          layers.origin[axis][to] = wave.origin[axis][from];
          layers.direction[axis][to] = wave.direction[axis][from];
        }
        layers.leaves[to] = wave.starts_at_eye ? kNothing : wave.leaves[from];
        layers.inside[to] = wave.starts_at_eye ? 0 : wave.inside[from];
        layers.weight[to] = ray.weight;
        for (int channel = 0; layers.has_tints && channel < 3; ++channel) layers.tint[channel][to] = ray.tint[channel];
        layers.owner[to] = wave.starts_at_eye ? from : wave.owner[from];
        buffers.t[to] = t;
        buffers.id[to] = id;
      };
      if (ray.next < found.first[k + 1]) {
        const RayHit& crossing = found.crossings[ray.next++];
        if (ray.weight >= kFaintestRay) add(crossing.t, crossing.sphere_id);
        ray.weight = ray.weight * to_eye()->passing(crossing.sphere_id);
        ray.tint = ray.tint * to_eye()->tint(crossing.sphere_id);
        left[kept++] = ray;
        continue;
      }
      if (depth == 1 && !passing_.empty()) passing_[static_cast<std::size_t>(from)] = ray.weight;
      // The background behind what a primary ray crosses is left out where the picture gets opacity instead.
      const bool crosses = found.first[k] < found.first[k + 1];
      if (settings_.without_background && depth == 1 && found.end_id[k] == kNothing && crosses)
        coverage_[static_cast<std::size_t>(from)] = 1 - ray.weight;
      else
        add(found.end[k], found.end_id[k]);
    }
    left.resize(kept);
  }
}

// Shades the surfaces of rays whose hits are known, and follows what these send on.
void WaveIntegrator::follow(const WavePart& rays, int depth, WaveBuffers& buffers) {
  // Shade all surfaces, and follow the reflected and the transmitted light.
  const bool last = depth == settings_.recursion;
  Wave* const next = last ? nullptr : &buffers.generations[static_cast<std::size_t>(depth)];
  if (next != nullptr) next->reset(2 * rays.count(), rays.wave->has_tints);
  if (rays.wave->starts_at_eye && last && settings_.light && !with_shadows() && !with_ambient() && !settings_.depth &&
      !scene_.shadows_only) {
    steps::shade_primaries(scene_, rays, buffers.t.data(), buffers.id.data(), buffers.sums);
    buffers.sums.empty = false;
    return;
  }
  const bool of_generation = with_shadows() || with_ambient();
  buffers.surfaces.reset(of_generation ? rays.count() : 0, rays.wave->has_tints);
  if (with_shadows()) buffers.shadows.reset(rays.count(), channels());
  for (std::int64_t first = rays.first; first < rays.last;) {
    const WavePart part{rays.wave, first, end_of_part(*rays.wave, first, rays.last, kRaysShadedAtOnce)};
    shade(part, depth, HitSpan{buffers.t.data(), buffers.id.data()}.part(first - rays.first), next, buffers);
    first = part.last;
  }
  if (of_generation) {
    find_levels(buffers);
    if (with_shadows()) find_shadows(depth, buffers);
    if (with_shadows()) find_soft_shadows(depth, buffers);
    if (with_ambient()) find_visibility(depth, buffers);
    if (cancelled()) return;
    if (shares(depth)) share_light(buffers);
    steps::LightReceived received;
    received.surfaces = buffers.surfaces.count;
    if (covers_by_shadows() && depth == 1) received.coverage = coverage_.data();
    if (with_shadows()) received.hidden = buffers.hidden.data();
    if (with_shadows() && to_light() != nullptr) received.share = ColourRows(buffers.share, channels());
    if (with_shadows() && settings_.light_points != nullptr) {
      received.facing = ColourRows(buffers.light_facing, channels());
      received.seen = ColourRows(buffers.light_seen, channels());
    }
    steps::add_local_light(scene_, buffers.surfaces, received,
                           with_ambient() ? ColourRows(buffers.visibility, channels()) : ColourRows(), buffers.sums);
  }
  buffers.sums.empty = false;

  // Follow these rays. Cut them between owners if there are too many.
  for (std::int64_t first = 0; next != nullptr && first < next->count;) {
    std::int64_t end = std::min(next->count, first + kMostRaysAtOnce);
    if (end < next->count) {
      const std::int64_t owner = next->owner[end];
      while (end > first && next->owner[end - 1] == owner) --end;
      if (end == first)
        while (end < next->count && next->owner[end] == owner) ++end;
    }
    trace_part({next, first, end}, depth + 1, buffers);
    if (cancelled()) return;
    first = end;
  }
}

void WaveIntegrator::shade(const WavePart& rays, int depth, const HitSpan& hits, Wave* next, WaveBuffers& buffers) {
  // Shadows and ambient occlusion need the surfaces of the whole generation.
  WaveSurfaces& surfaces = buffers.surfaces;
  if (!with_shadows() && !with_ambient()) surfaces.reset(rays.count(), rays.wave->has_tints);
  const std::int64_t known = surfaces.count;
  steps::find_surfaces(scene_, rays, hits.t, hits.sphere_id, surfaces, buffers.sums);
  if (settings_.depth)
    for (std::int64_t k = known; k < surfaces.count; ++k) {
      if (scene_.shadows_only && surfaces.id[k] == kPlane) continue;
      const auto owner = static_cast<std::size_t>(surfaces.owner[k]);
      deepest_hit_[owner] = static_cast<std::uint8_t>(depth);
      if (covers_by_shadows() && coverage_[owner] == kUncovered) coverage_[owner] = 1;
    }
  if (with_shadows()) {
    const std::vector<PointLight>& lights = scene_.lights;
    if (!lights.empty() && !is_soft(lights[0])) steps::find_shadow_rays(surfaces, known, lights[0], buffers.shadows);
  } else if (settings_.light && !with_ambient()) {
    steps::LightReceived received;
    if (covers_by_shadows() && depth == 1) received.coverage = coverage_.data();
    steps::add_local_light(scene_, surfaces, received, {}, buffers.sums);
  }
  if (next == nullptr) return;
  const steps::SpawnedRays spawned = steps::spawn_secondary_rays(scene_, surfaces, known, *next);
  rays_.reflected += spawned.reflected;
  rays_.transmitted += spawned.transmitted;
}

// Faint surfaces occur only where spheres are passed straight.
void WaveIntegrator::find_levels(WaveBuffers& buffers) const {
  if (to_eye() == nullptr) return;
  const WaveSurfaces& surfaces = buffers.surfaces;
  buffers.level.reserve(surfaces.count);
  for (std::int64_t i = 0; i < surfaces.count; ++i) {
    const double share = surfaces.weight[i] * to_eye()->stopping(surfaces.id[i]);
    buffers.level[i] = static_cast<std::uint8_t>(faint_level(share));
  }
}

void WaveIntegrator::group_places(int sets, WaveBuffers& buffers) const {
  const std::uint8_t* const level_of = levels() > 1 ? buffers.level.data() : nullptr;
  steps::group_places(buffers.surfaces, {first_sample_, settings_.samples_per_pixel, sets, levels(), level_of},
                      buffers.groups);
}

void WaveIntegrator::find_shadows(int depth, WaveBuffers& buffers) {
  const std::int64_t surfaces = buffers.surfaces.count;
  const std::vector<PointLight>& lights = scene_.lights;
  const std::int64_t all = surfaces * static_cast<std::int64_t>(lights.size());
  buffers.hidden.reserve(all);
  std::fill_n(buffers.hidden.data(), all, std::uint8_t{0});
  for (int channel = 0; to_light() != nullptr && channel < channels(); ++channel) {
    buffers.share[channel].reserve(all);
    std::fill_n(buffers.share[channel].data(), all, 1.0);
  }
  ShadowWave& shadows = buffers.shadows;
  for (std::size_t l = 0; l < lights.size(); ++l) {
    if (is_soft(lights[l])) continue;
    // The shadow rays towards the first light exist already.
    if (l > 0) {
      shadows.reset(surfaces, channels());
      steps::find_shadow_rays(buffers.surfaces, 0, lights[l], shadows);
    }
    rays_.shadow += shadows.count;

    // The shadow rays of the first generation are neighbours, as their pixels are.
    const RayOrder order = depth == 1 ? RayOrder::blocks : RayOrder::any;
    for_each_span(shadows.span(), [&](const RaySpan& some, std::int64_t at) {
      ask_for_light(some, order, shadows.hidden.data() + at, shadows.share, at);
    });
    const std::int64_t row = static_cast<std::int64_t>(l) * surfaces;
    for (std::int64_t i = 0; i < shadows.count; ++i) buffers.hidden[row + shadows.surface[i]] = shadows.hidden[i];
    if (to_light() == nullptr) continue;
    for (int channel = 0; channel < channels(); ++channel)
      for (std::int64_t i = 0; i < shadows.count; ++i)
        buffers.share[channel][row + shadows.surface[i]] = shadows.share[channel][i];
  }
}

// The rays towards one point of a light start at neighbouring places: beams take them.
void WaveIntegrator::find_soft_shadows(int depth, WaveBuffers& buffers) {
  if (settings_.light_points == nullptr) return;
  const WaveSurfaces& surfaces = buffers.surfaces;
  const LightPointSets& points = *settings_.light_points;
  std::vector<const PointLight*> lights;
  for (const PointLight& light : scene_.lights)
    if (is_soft(light)) lights.push_back(&light);
  const std::int64_t all = surfaces.count * static_cast<std::int64_t>(lights.size());
  for (int channel = 0; channel < channels(); ++channel) {
    buffers.light_facing[channel].reserve(all);
    buffers.light_seen[channel].reserve(all);
  }
  if (shares(depth)) buffers.light_in_front.reserve(all);
  PlaceWave& wave = buffers.places;
  group_places(points.count(), buffers);
  for (int n = 0; n < points.count() * levels(); ++n) {
    const int set = n % points.count();
    const int level = n / points.count();
    steps::gather_places(surfaces, buffers.groups, n, channels(), wave);
    if (wave.places == 0) continue;
    const std::vector<Vec3d>& of_set = points.of_sample(set, level);
    const auto count = static_cast<double>(of_set.size());
    for (std::size_t l = 0; l < lights.size(); ++l) {
      steps::forget_sums(wave);
      const auto towards = [&](std::size_t i) {
        steps::find_light_rays(lights[l]->position + lights[l]->radius * of_set[i], wave);
      };
      trace_places_of_all(of_set.size(), depth, 1, buffers, towards, [&](const RaySpan& rays) {
        rays_.shadow += rays.count;
        for (std::int64_t i = 0; shares(depth) && i < rays.count; ++i) wave.in_front[wave.place[i]] += wave.facing[i];
        steps::add_visible(wave);
      });
      if (cancelled()) return;
      const std::int64_t row = static_cast<std::int64_t>(l) * surfaces.count;
      for (int channel = 0; channel < channels(); ++channel)
        for (std::int64_t k = 0; k < wave.places; ++k) {
          buffers.light_facing[channel][row + wave.surface[k]] = wave.seen[channel][k] / count;
          buffers.light_seen[channel][row + wave.surface[k]] = wave.rays_seen[channel][k] / count;
        }
      for (std::int64_t k = 0; shares(depth) && k < wave.places; ++k)
        buffers.light_in_front[row + wave.surface[k]] = wave.in_front[k] / count;
    }
  }
}

// All rays of one direction are parallel, and neighbours start at neighbouring places: beams take them.
void WaveIntegrator::find_visibility(int depth, WaveBuffers& buffers) {
  const WaveSurfaces& surfaces = buffers.surfaces;
  const AmbientRays& ambient = *settings_.ambient;
  PlaceWave& wave = buffers.places;
  for (int channel = 0; channel < channels(); ++channel) buffers.visibility[channel].reserve(surfaces.count);
  if (shares(depth)) buffers.in_front.reserve(surfaces.count);
  group_places(ambient.sets.count(), buffers);
  for (int n = 0; n < ambient.sets.count() * levels(); ++n) {
    const int set = n % ambient.sets.count();
    const int level = n / ambient.sets.count();
    steps::gather_places(surfaces, buffers.groups, n, channels(), wave);
    if (wave.places == 0) continue;
    const std::vector<Vec3f>& directions = ambient.sets.of_sample(set, level);
    const auto towards = [&](std::size_t i) { steps::find_ambient_rays(directions[i], wave); };
    trace_places_of_all(directions.size(), depth, ambient.distance, buffers, towards, [&](const RaySpan& rays) {
      rays_.ambient += rays.count;
      if (scene_.scene->plane)
        for (std::int64_t i = 0; i < rays.count; ++i)
          if (plane_hit(rays.at(i), scene_.plane) < std::numeric_limits<double>::infinity()) wave.hidden[i] = 1;
      steps::add_visible(wave);
    });
    if (cancelled()) return;
    for (int channel = 0; channel < channels(); ++channel)
      for (std::int64_t k = 0; k < wave.places; ++k)
        buffers.visibility[channel][wave.surface[k]] =
            wave.in_front[k] > 0 ? wave.seen[channel][k] / wave.in_front[k] : 1;
    for (std::int64_t k = 0; shares(depth) && k < wave.places; ++k)
      buffers.in_front[wave.surface[k]] = wave.in_front[k];
  }
}

// Each surface knows what few rays brought; together neighbours have as many directions and points as there are in all
// sets. A light's facing is that of the surface itself, and the share of it that arrives is the neighbours'.
void WaveIntegrator::share_light(WaveBuffers& buffers) const {
  const std::int64_t surfaces = buffers.surfaces.count;
  steps::find_neighbours(buffers.surfaces, pixel_, buffers.neighbours);
  for (int channel = 0; with_ambient() && channel < channels(); ++channel)
    steps::share(buffers.neighbours, buffers.in_front.data(), buffers.visibility[channel].data());
  if (!with_shadows() || settings_.light_points == nullptr) return;
  std::int64_t row = 0;
  for (const PointLight& light : scene_.lights) {
    if (!is_soft(light)) continue;
    const double* const in_front = buffers.light_in_front.data() + row;
    for (int channel = 0; channel < channels(); ++channel) {
      double* const facing = buffers.light_facing[channel].data() + row;
      for (std::int64_t i = 0; i < surfaces; ++i) facing[i] = in_front[i] > 0 ? facing[i] / in_front[i] : 0;
      steps::share(buffers.neighbours, in_front, facing);
      for (std::int64_t i = 0; i < surfaces; ++i) facing[i] = facing[i] * in_front[i];
      steps::share(buffers.neighbours, nullptr, buffers.light_seen[channel].data() + row);
    }
    row += surfaces;
  }
}

// What of the light arrives at the ends of rays? The shares, from number `first` on, are written only where there are
// transparent spheres.
void WaveIntegrator::ask_for_light(const RaySpan& rays, RayOrder order, std::uint8_t* hidden, Columns3<double>& share,
                                   std::int64_t first) const {
  if (to_light() == nullptr) return tracer_.occluded(rays, order, hidden);
  to_light()->hides(rays, order, hidden);

  // Rays that are hidden anyway get an end before their start, so they cross nothing.
  RaySpan open = rays;
  if (std::memchr(hidden, 1, static_cast<std::size_t>(rays.count)) != nullptr) {
    static thread_local std::vector<double> ends;
    ends.resize(static_cast<std::size_t>(rays.count));
    for (std::int64_t i = 0; i < rays.count; ++i) {
      const double end = rays.t_max != nullptr ? rays.t_max[i] : std::numeric_limits<double>::infinity();
      ends[static_cast<std::size_t>(i)] = hidden[i] != 0 ? -std::numeric_limits<double>::infinity() : end;
    }
    open.t_max = ends.data();
  }
  double* columns[3] = {};
  for (int channel = 0; channel < channels(); ++channel) columns[channel] = share[channel].data() + first;
  to_light()->find_shares(open, order, columns);
  for (std::int64_t ray = 0; ray < rays.count; ++ray) {
    bool any = false;
    for (int channel = 0; channel < channels(); ++channel) any |= columns[channel][ray] != 0;
    if (!any) hidden[ray] = 1;
  }
}

// Calls make(i), which puts rays into buffers.places, and use(these rays) when it is known which of them a sphere hides
// before t = limit, for each i from 0 to before `count`. Other processes are asked for many i at a time, because each
// question waits for its answer.
template <class MakeRays, class Use>
void WaveIntegrator::trace_places_of_all(std::size_t count, int depth, double limit, WaveBuffers& buffers,
                                         const MakeRays& make, const Use& use) const {
  PlaceWave& wave = buffers.places;
  AnswersAhead& ahead = buffers.ahead;
  ahead.next = ahead.rays.size();
  const auto at_once = static_cast<std::size_t>(std::max<std::int64_t>(1, kMostRaysAskedAhead / wave.places));
  for (std::size_t i = 0; i < count && !cancelled(); ++i) {
    if (tracer_.remote() != nullptr && !ahead.any()) {
      ahead.rays.clear();
      ahead.next = 0;
      // Making rays adds to this sum, and these are made again.
      const std::vector<double> in_front(wave.in_front.data(), wave.in_front.data() + wave.places);
      for (std::size_t k = i; k < std::min(count, i + at_once); ++k) {
        make(k);
        ahead.rays.append(wave.rays.span());
      }
      std::copy(in_front.begin(), in_front.end(), wave.in_front.data());
      ahead.hidden.resize(static_cast<std::size_t>(ahead.rays.size()));
      for (int channel = 0; channel < channels(); ++channel) ahead.share[channel].reserve(ahead.rays.size());
      std::vector<double> limits(ahead.hidden.size(), limit);
      RaySpan rays = ahead.rays.span();
      rays.t_max = limits.data();
      ask_for_light(rays, RayOrder::any, ahead.hidden.data(), ahead.share, 0);
    }
    make(i);
    const RaySpan rays = trace_places(depth, limit, buffers);
    if (cancelled()) return;
    use(rays);
  }
}

// Which rays of the places does a sphere hide before t = limit? Returns these rays.
RaySpan WaveIntegrator::trace_places(int depth, double limit, WaveBuffers& buffers) const {
  PlaceWave& wave = buffers.places;
  wave.has_shares = to_light() != nullptr;
  RaySpan rays = wave.rays.span();
  if (limit < std::numeric_limits<double>::infinity()) {
    buffers.limits.reserve(rays.count);
    std::fill_n(buffers.limits.data(), rays.count, limit);
    rays.t_max = buffers.limits.data();
  }
  if (AnswersAhead& ahead = buffers.ahead; ahead.any()) {
    std::copy_n(ahead.hidden.data() + ahead.next, rays.count, wave.hidden.data());
    for (int channel = 0; wave.has_shares && channel < channels(); ++channel)
      std::copy_n(ahead.share[channel].data() + ahead.next, rays.count, wave.share[channel].data());
    ahead.next += rays.count;
    return rays;
  }
  const RayOrder order = depth == 1 ? RayOrder::blocks : RayOrder::any;
  for_each_span(rays, [&](const RaySpan& some, std::int64_t at) {
    ask_for_light(some, order, wave.hidden.data() + at, wave.share, at);
  });
  return rays;
}

}  // namespace bihive
