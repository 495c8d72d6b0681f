#include "pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "bihive/base/version.h"
#include "bihive/image/png.h"
#include "support/failure.h"

namespace bihive::thesis {

cli::PictureSize picture_size(const Settings& settings, const Values& values, int quick_divisor) {
  constexpr std::int64_t kLargestPx = 65535;
  const int divisor = settings.quick ? quick_divisor : 1;
  const auto side = [&](const std::string& name) {
    return static_cast<int>(std::clamp<std::int64_t>(values.integer(name) / divisor, 1, kLargestPx));
  };
  return {side("width_px"), side("height_px")};
}

RenderSettings picture_settings(const StepContext& context, const Scene& scene, cli::PictureSize size, View view) {
  RenderSettings settings = settings_from(scene.picture);
  settings.width_px = size.width_px;
  settings.height_px = size.height_px;
  settings.view = view;
  settings.threads = context.settings.threads;
  return settings;
}

std::optional<Image> draw(const StepContext& context, const Scene& scene, const Tracer& tracer,
                          const RenderSettings& settings, std::int64_t* rays) {
  const Result<Rendered> rendered = render(scene, tracer, settings, {}, &context.cancel);
  if (context.cancel.cancelled()) return std::nullopt;
  if (!rendered) cli::fail(rendered.error());
  if (rays != nullptr) *rays = rendered->rays.primary + rendered->rays.reflected + rendered->rays.transmitted;
  return image_from_film(rendered->film, settings.view, scene.picture.transfer);
}

Json write_picture(const StepContext& context, const std::string& name, const Image& image) {
  const PngText text{{"Software", "bihive " + std::string(version())}};
  if (const Status status = write_png(context.folder + "/" + name, image, text); !status) cli::fail(status.error());
  std::set<std::uint32_t> colours;
  for (std::size_t i = 0; i + 2 < image.rgb.size(); i += 3)
    colours.insert(std::uint32_t{image.rgb[i]} << 16 | std::uint32_t{image.rgb[i + 1]} << 8 | image.rgb[i + 2]);
  return {{"name", name},
          {"width_px", image.width},
          {"height_px", image.height},
          {"picture_hash", fmt::format("{:016x}", picture_hash(image))},
          {"colours", colours.size()}};
}

std::vector<double> numbers_of(Vec3d vector) {
  return {vector.x, vector.y, vector.z};
}

}  // namespace bihive::thesis
