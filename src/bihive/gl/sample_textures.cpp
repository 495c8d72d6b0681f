#include "bihive/gl/sample_textures.h"

#include <algorithm>

#include "bihive/gl/film_textures.h"
#include "bihive/gl/tree_textures.h"
#include "bihive/scene/ambient_occlusion.h"
#include "bihive/scene/light_points.h"

namespace bihive {
namespace {

constexpr double kFarthestOcclusion = 1e30;  // binary32 holds it

template <class Vector>
void add(const std::vector<Vector>& set, std::vector<float>& rgba) {
  for (const Vector& v : set) rgba.insert(rgba.end(), {float(v.x), float(v.y), float(v.z), 0.0F});
}

}  // namespace

void SampleTextures::set(const RenderSettings& settings, bool soft_light, double scale) {
  const int samples = settings.samples_per_pixel;
  camera_ = camera_samples(samples);
  const bool shaded = settings.view == View::shaded;
  std::vector<float> rgba;
  directions_.size = 0;
  directions_.count = 1;
  if (shaded && settings.ambient_occlusion) {
    const AmbientRays ambient(*settings.ambient_occlusion, samples);
    directions_.size = settings.ambient_occlusion->directions;
    directions_.count = ambient.sets.count();
    for (int level = 0; level < kFaintLevels; ++level)
      for (int i = 0; i < directions_.count; ++i) add(ambient.sets.of_sample(i, level), rgba);
    ambient_distance_ = static_cast<float>(std::min(ambient.distance * scale, kFarthestOcclusion));
  }
  upload(rgba, directions_);

  rgba.clear();
  light_points_.size = 0;
  light_points_.count = 1;
  if (shaded && settings.shadows && soft_light) {
    const LightPointSets points(settings.light_points, samples);
    light_points_.size = settings.light_points;
    light_points_.count = points.count();
    for (int level = 0; level < kFaintLevels; ++level)
      for (int i = 0; i < light_points_.count; ++i) add(points.of_sample(i, level), rgba);
  }
  upload(rgba, light_points_);
}

// An empty set becomes one row of zeros, because a sampler needs a texture of its kind.
void SampleTextures::upload(const std::vector<float>& rgba, Sets& sets) const {
  constexpr std::size_t kRow = std::size_t{4} * kTextureWidth;
  std::vector<float> rows = rgba;
  rows.resize(std::max<std::size_t>(1, (rgba.size() + kRow - 1) / kRow) * kRow);
  gl_->ActiveTexture(GL_TEXTURE0);
  if (sets.texture == 0) sets.texture = make_texture(*gl_);
  gl_->PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  gl_->BindTexture(GL_TEXTURE_2D, sets.texture);
  gl_->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, kTextureWidth, static_cast<GLsizei>(rows.size() / kRow), 0, GL_RGBA,
                  GL_FLOAT, rows.data());
  gl_->BindTexture(GL_TEXTURE_2D, 0);
}

void SampleTextures::destroy() {
  for (Sets* sets : {&directions_, &light_points_}) {
    if (sets->texture != 0) gl_->DeleteTextures(1, &sets->texture);
    sets->texture = 0;
  }
}

void SampleTextures::put(GlProgram& program, int sample, int first_unit) const {
  int unit = first_unit;
  for (const Sets* sets : {&directions_, &light_points_}) {
    gl_->ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit++));
    gl_->BindTexture(GL_TEXTURE_2D, sets->texture);
  }
  gl_->ActiveTexture(GL_TEXTURE0);
  const SamplePlace place = camera_sample(sample).place;
  program.set("sample_place", float(place.x), float(place.y));
  program.set("directions", first_unit);
  program.set("direction_set", sample % directions_.count);
  program.set("direction_sets", directions_.count);
  program.set("direction_count", directions_.size);
  program.set("ambient_distance", ambient_distance_);
  program.set("light_points", first_unit + 1);
  program.set("light_point_set", sample % light_points_.count);
  program.set("light_point_sets", light_points_.count);
  program.set("light_point_count", light_points_.size);
}

}  // namespace bihive
