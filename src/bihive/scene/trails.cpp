#include "bihive/scene/trails.h"

#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "bihive/base/setting_name.h"
#include "bihive/geometry/lattice.h"
#include "bihive/scene/stick_colours.h"
#include "bihive/select/selection.h"

namespace bihive {

Result<AddedTrails> add_trails(Scene& scene, const std::vector<std::shared_ptr<const SphereSet>>& earlier,
                               const Trails& trails) {
  SphereSet& spheres = scene.spheres;
  std::vector<std::uint8_t> mask(static_cast<std::size_t>(spheres.size()), 1);
  if (!trails.select.empty()) {
    Result<std::vector<std::uint8_t>> selected = select_spheres(spheres, trails.select);
    if (!selected) return error_of_setting("trail_select", selected.error());
    mask = std::move(*selected);
  }

  // The latest frames that have the same spheres.
  AddedTrails added;
  const std::int64_t count = scene.id_in_input.empty() ? spheres.size() : scene.size_of_input;
  std::vector<const SphereSet*> latest_first;
  for (std::size_t k = earlier.size(); k > 0 && static_cast<std::int64_t>(latest_first.size()) < trails.frames; --k) {
    if (earlier[k - 1]->size() != count) {
      added.other_count = true;
      break;
    }
    latest_first.push_back(earlier[k - 1].get());
  }
  added.frames = static_cast<std::int64_t>(latest_first.size());

  const std::optional<Lattice> lattice = Lattice::of(spheres.cell());
  std::vector<OwnStick> sticks;
  for (std::int64_t id = 0; id < spheres.size(); ++id) {
    if (mask[static_cast<std::size_t>(id)] == 0) continue;
    OwnStick step;
    step.sphere = static_cast<std::int32_t>(id);
    step.radius_a = std::isinf(trails.radius) ? kTrailRadius * spheres.radius(id) : trails.radius;
    step.radius_b = step.radius_a;
    step.b = spheres.local_centre(id);
    bool moved = false;
    for (std::size_t k = 0; k < latest_first.size(); ++k, step.b = step.a) {
      step.a = spheres.to_local(latest_first[k]->centre(input_id(scene, id)));
      if (step.a == step.b) continue;
      if (lattice && nearest_image(step.a, step.b, *lattice) != ImageCounts{}) {
        ++added.broken;
        continue;
      }
      if (!(step.radius_a > 0))
        return Error{setting_name("trail") + ": sphere " + std::to_string(input_id(scene, id)) +
                         " has radius 0, and a trail is a fifth as thick as its sphere",
                     "", 0, 0, "state the radius of all trails: " + setting_name("trail_radius") + " R"};
      step.opacity = static_cast<float>(1 - (static_cast<double>(k) + 0.5) / static_cast<double>(trails.frames));
      sticks.push_back(step);
      moved = true;
    }
    added.trails += moved ? 1 : 0;
  }
  if (Status status = scene.sticks.add(spheres, sticks); !status) return error_of_setting("trail", status.error());
  added.sticks = static_cast<std::int64_t>(sticks.size());
  return added;
}

}  // namespace bihive
