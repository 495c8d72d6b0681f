#include "bihive/scene/image_colours.h"

#include "bihive/scene/colour_of_number.h"
#include "bihive/select/number_term.h"

namespace bihive {
ImageColours::ImageColours(const Scene& scene) : scene_(scene) {
  if (!scene.spheres.has_images() || scene.spheres.attributes().colour.empty()) return;
  for (const ColourBy& how : scene.coloured_by) {
    FoundAttribute attribute;
    if (const Result<FoundAttribute> found = find_numbers(scene.spheres, how.attribute);
        found && found->differs_by_image())
      attribute = *found;
    any_ = any_ || attribute.has_numbers();
    by_place_.push_back(attribute);
  }
}

Vec3f ImageColours::colour(std::int64_t id) const {
  const auto stored = static_cast<std::size_t>(scene_.spheres.stored_id(id));
  const Vec3f own = scene_.spheres.attributes().colour[stored];
  if (!any_ || id < scene_.spheres.size()) return own;
  const std::int32_t meaning = scene_.coloured_by_of_sphere.empty() ? 0 : scene_.coloured_by_of_sphere[stored];
  if (meaning < 0) return own;
  const FoundAttribute& attribute = by_place_[static_cast<std::size_t>(meaning)];
  if (!attribute.has_numbers()) return own;
  return colour_of_number(scene_.coloured_by[static_cast<std::size_t>(meaning)],
                          attribute.number_of(scene_.spheres, id), scene_.picture.transfer);
}

}  // namespace bihive
