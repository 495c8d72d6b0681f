#include "bihive/scene/show_density.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "bihive/base/readable.h"
#include "bihive/io/read_spheres.h"

namespace bihive {
namespace {

// Removes the reader's notes on radii that the style has replaced.
void remove_notes(std::vector<std::string>& notes, std::string_view beginning) {
  std::erase_if(notes, [&](const std::string& note) { return note.starts_with(beginning); });
}

}  // namespace

void show_density(LoadedScene& loaded, const std::optional<Density>& density) {
  SphereSet& spheres = loaded.scene.spheres;
  if (spheres.empty()) return;
  const std::optional<Density> before = loaded.density;
  loaded.density = density;
  if (density && density->radius) {
    if (!loaded.radius_without_density) loaded.radius_without_density = spheres.radius(0);
    set_radius(spheres, *density->radius);
  } else if (loaded.radius_without_density) {
    set_radius(spheres, *loaded.radius_without_density);
    loaded.radius_without_density.reset();
  }
  std::vector<float>& opacity = spheres.attributes().opacity;
  if (density && density->opacity)
    opacity.assign(static_cast<std::size_t>(spheres.size()), static_cast<float>(*density->opacity));
  else if (before && before->opacity)
    opacity.clear();
}

void take_density(LoadedScene& loaded, const Style& style) {
  if (!style.density || loaded.scene.spheres.empty()) return;
  const Density density = density_of(loaded.scene.spheres, *style.density, loaded.has_assumed_radii);
  show_density(loaded, density);
  if (density.radius) {
    remove_notes(loaded.warnings, kNoRadii);
    remove_notes(loaded.rules, "radii: ");
    loaded.rules.push_back("radii: " + readable_number(*density.radius) + ", as the style " + style.name +
                           " draws points");
  }
  if (density.opacity)
    loaded.rules.push_back("opacity: " + readable_number(*density.opacity) + ", by the density of the spheres");
}

}  // namespace bihive
