#include "pictures.h"

#include <fmt/format.h>

#include <array>
#include <set>

#include "bihive/base/version.h"
#include "bihive/image/png.h"

namespace bihive::thesis {

RenderSettings picture_settings(const Experiment& experiment, const Scene& scene, View view, int quick_divisor) {
  const int divisor = experiment.settings.quick ? quick_divisor : 1;
  RenderSettings settings = settings_from(scene.picture);
  settings.width_px = experiment.values.side("width_px", divisor);
  settings.height_px = experiment.values.side("height_px", divisor);
  settings.view = view;
  settings.threads = experiment.settings.threads;
  return settings;
}

std::optional<Image> draw(const Experiment& experiment, const Scene& scene, const Tracer& tracer,
                          const RenderSettings& settings, std::int64_t* rays) {
  const Result<Rendered> rendered = render(scene, tracer, settings, {}, &experiment.cancel);
  if (experiment.cancel.cancelled()) return std::nullopt;
  if (!rendered) fail(rendered.error());
  if (rays != nullptr) *rays = rendered->rays.primary + rendered->rays.reflected + rendered->rays.transmitted;
  return image_from_film(rendered->film, settings.view, scene.picture.transfer);
}

Json write_picture(const Experiment& experiment, const std::string& name, const Image& image) {
  const PngText text{{"Software", "bihive " + std::string(version())}};
  value_or_fail(write_png(experiment.folder + "/" + name, image, text));
  return {{"name", name},
          {"width_px", image.width},
          {"height_px", image.height},
          {"picture_hash", fmt::format("{:016x}", picture_hash(image))}};
}

std::int64_t coinciding_spheres(const SphereSet& spheres) {
  std::set<std::array<double, 3>> places;
  for (std::int64_t id = 0; id < spheres.size(); ++id) {
    const Vec3d centre = spheres.centre(id);
    places.insert({centre.x, centre.y, centre.z});
  }
  return spheres.size() - static_cast<std::int64_t>(places.size());
}

}  // namespace bihive::thesis
