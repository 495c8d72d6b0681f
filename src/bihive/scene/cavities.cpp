#include "bihive/scene/cavities.h"

#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "bihive/base/setting_name.h"
#include "bihive/measure/cavity_walls.h"
#include "bihive/scene/clips.h"
#include "bihive/scene/looks.h"

namespace bihive {
namespace {

constexpr const char* kColumnOfCavities = "cavity";

Status check_scene_of_cavities(const Scene& scene) {
  const auto refused = [](const std::string& what, const std::string& hint) {
    return Error{"pictures of cavities show no " + what, "", 0, 0, hint};
  };
  if (scene.spheres.has_images()) return refused("copies", "leave out " + setting_name("replicate"));
  if (has_clips(scene)) return refused("cut spheres", "leave out " + setting_name("clip"));
  if (!scene.sticks.empty()) return refused("bonds, arrows, tubes and links", "leave them out");
  const SphereAttributes& attributes = scene.spheres.attributes();
  if (attributes.find_numbers(kColumnOfCavities) != nullptr || attributes.find_texts(kColumnOfCavities) != nullptr)
    return Error{std::string("there is a column ") + kColumnOfCavities + " already", "", 0, 0,
                 "leave out " + setting_name("show_cavities")};
  return Done{};
}

Status do_look(Scene& scene, const std::string& select, LookAction action) {
  const Result<std::vector<std::int64_t>> done = apply_looks(scene, {Look{select, {std::move(action)}}});
  return done ? Status(Done{}) : Status(done.error());
}

}  // namespace

Result<ShownCavities> show_cavities(Scene& scene, double probe, int threads) {
  if (Status status = check_scene_of_cavities(scene); !status) return status.error();
  const SphereSet& spheres = scene.spheres;
  if (spheres.empty()) return ShownCavities{};
  std::vector<double> radii;
  for (std::int64_t id = 0; id < spheres.size(); ++id) radii.push_back(spheres.radius(id) + probe);
  if (Status status = do_look(scene, "all", SetRadii{std::move(radii)}); !status) return status.error();

  std::vector<std::int64_t> ids(static_cast<std::size_t>(spheres.size()));
  std::iota(ids.begin(), ids.end(), std::int64_t{0});
  Result<CavityWalls> walls = CavityWalls::of(spheres.part(ids), threads);
  if (!walls) return walls.error();
  const ShownCavities shown{walls->cavities(), walls->undecided_spheres()};
  const std::vector<std::int32_t>& cavities = walls->cavity_of_sphere();
  scene.spheres.attributes().numbers.push_back(
      {kColumnOfCavities, std::vector<double>(cavities.begin(), cavities.end())});
  if (shown.cavities == 0) {
    const std::vector<double> none(ids.size(), 0);
    if (Status status = do_look(scene, "all", SetRadii{none}); !status) return status.error();
    return shown;
  }
  if (Status status = do_look(scene, "cavity < 1", SetShown{false}); !status) return status.error();
  scene.cavity_walls = std::make_shared<const CavityWalls>(std::move(*walls));
  return shown;
}

}  // namespace bihive
