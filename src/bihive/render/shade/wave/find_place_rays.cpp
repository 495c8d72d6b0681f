#include <algorithm>

#include "bihive/render/shade/wave/wave.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bihive/render/shade/wave/find_place_rays.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "bihive/render/query/lanes-inl.h"
#include "bihive/render/shade/wave/light-inl.h"
#include "bihive/simd/dispatch.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {

void find_ambient_rays_on_target(Vec3f direction, PlaceWave& wave) {
  const Lanes3 along = all(to_double(direction));
  RayColumns& rays = wave.rays;
  rays.count = 0;
  for (std::int64_t i = 0; i < wave.places; i += kLanes) {
    const Lanes facing = dot(load(wave.normal, i), along);
    const LaneMask asks = hn::And(hn::Gt(facing, all(0)), first_lanes(wave.places - i));
    if (none(asks)) continue;
    store(hn::Add(load(wave.in_front, i), hn::IfThenElseZero(asks, facing)), wave.in_front, i);
    const Appender append(asks, rays.count);
    append(load(wave.origin, i), rays.origin);
    append(along, rays.direction);
    append(load(wave.id, i), rays.leaves);
    append(load(wave.inside, i), rays.inside);
    append(facing, wave.facing);
    append(counted_from(i), wave.place);
    rays.count += append.count();
  }
}

void find_light_rays_on_target(Vec3d point, PlaceWave& wave) {
  RayColumns& rays = wave.rays;
  rays.count = 0;
  for (std::int64_t i = 0; i < wave.places; i += kLanes) {
    const Lanes3 origin = load(wave.origin, i);
    const LightLanes to_point(point, origin, load(wave.normal, i));
    const LaneMask asks = hn::And(to_point.in_front, first_lanes(wave.places - i));
    if (none(asks)) continue;
    const Appender append(asks, rays.count);
    append(origin, rays.origin);
    append(to_point.offset, rays.direction);
    append(load(wave.id, i), rays.leaves);
    append(load(wave.inside, i), rays.inside);
    append(hn::Mul(to_point.towards, to_point.nearness()), wave.facing);
    append(counted_from(i), wave.place);
    rays.count += append.count();
  }
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bihive {
HWY_EXPORT(find_ambient_rays_on_target);
HWY_EXPORT(find_light_rays_on_target);

namespace steps {

void group_places(const WaveSurfaces& surfaces, const Grouping& by, PlaceGroups& groups) {
  static thread_local std::vector<std::uint32_t> group_of;
  group_of.resize(static_cast<std::size_t>(surfaces.count));
  const auto count = static_cast<std::size_t>(by.levels * by.sets);
  groups.first.assign(count + 1, 0);
  for (std::int64_t i = 0; i < surfaces.count; ++i) {
    const std::int64_t level = by.level_of != nullptr ? by.level_of[i] : 0;
    const std::int64_t set = (by.first_sample + surfaces.owner[i]) % by.samples % by.sets;
    const auto group = static_cast<std::uint32_t>(level * by.sets + set);
    group_of[static_cast<std::size_t>(i)] = group;
    ++groups.first[group + 1];
  }
  for (std::size_t group = 0; group < count; ++group) groups.first[group + 1] += groups.first[group];
  groups.surfaces.resize(static_cast<std::size_t>(surfaces.count));
  std::vector<std::int64_t> next(groups.first.begin(), groups.first.end() - 1);
  for (std::int64_t i = 0; i < surfaces.count; ++i)
    groups.surfaces[static_cast<std::size_t>(next[group_of[static_cast<std::size_t>(i)]]++)] = i;
}

void gather_places(const WaveSurfaces& surfaces, const PlaceGroups& groups, std::int64_t group, int channels,
                   PlaceWave& wave) {
  const std::int64_t begin = groups.first[static_cast<std::size_t>(group)];
  const std::int64_t end = groups.first[static_cast<std::size_t>(group) + 1];
  wave.reset(end - begin, channels);
  for (std::int64_t at = begin; at < end; ++at) {
    const std::int64_t i = groups.surfaces[static_cast<std::size_t>(at)];
    const std::int64_t k = wave.places++;
    for (int axis = 0; axis < 3; ++axis) {
      wave.origin[axis][k] = surfaces.origin[axis][i];
      wave.normal[axis][k] = surfaces.normal[axis][i];
    }
    wave.id[k] = surfaces.id[i];
    wave.inside[k] = surfaces.material_inside[i] & 1;
    wave.surface[k] = i;
  }
  forget_sums(wave);
}

void forget_sums(PlaceWave& wave) {
  std::fill_n(wave.in_front.data(), wave.places, 0.0);
  for (int channel = 0; channel < wave.channels; ++channel)
    for (Columns3<double>* columns : {&wave.seen, &wave.rays_seen})
      std::fill_n((*columns)[channel].data(), wave.places, 0.0);
}

void find_ambient_rays(Vec3f direction, PlaceWave& wave) {
  ensure_target();
  HWY_DYNAMIC_DISPATCH(find_ambient_rays_on_target)(direction, wave);
}

void find_light_rays(Vec3d point, PlaceWave& wave) {
  ensure_target();
  HWY_DYNAMIC_DISPATCH(find_light_rays_on_target)(point, wave);
}

void add_visible(PlaceWave& wave) {
  for (int channel = 0; channel < wave.channels; ++channel) {
    Column<double>& seen = wave.seen[channel];
    Column<double>& rays_seen = wave.rays_seen[channel];
    for (std::int64_t i = 0; i < wave.rays.count; ++i) {
      if (wave.hidden[i] != 0) continue;
      const std::int64_t place = wave.place[i];
      const double share = wave.has_shares ? wave.share[channel][i] : 1;
      seen[place] = seen[place] + wave.facing[i] * share;
      rays_seen[place] = rays_seen[place] + share;
    }
  }
}

}  // namespace steps
}  // namespace bihive
#endif
