#include "bihive/gl/scene_on_gpu.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "bihive/gl/film_textures.h"

namespace bihive {
namespace {

// Indices of SceneOnGpu's textures.
constexpr std::array<const char*, 5> kSamplers{"spheres", "sphere_info", "nodes", "looks", "lights"};
constexpr std::size_t kLights = 4;
constexpr int kFirstUnit = 1;

void upload(const GlFunctions& gl, const Texels<float, 4>& texels) {
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, texels.width(), texels.height(), 0, GL_RGBA, GL_FLOAT,
                texels.channels.data());
}
void upload(const GlFunctions& gl, const Texels<std::uint32_t, 4>& texels) {
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32UI, texels.width(), texels.height(), 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT,
                texels.channels.data());
}
void upload(const GlFunctions& gl, const Texels<std::uint32_t, 2>& texels) {
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RG32UI, texels.width(), texels.height(), 0, GL_RG_INTEGER, GL_UNSIGNED_INT,
                texels.channels.data());
}

// A few stack sizes only, so that few programs are compiled.
int rounded_up(int number, int step) {
  return (std::max(number, 1) + step - 1) / step * step;
}

}  // namespace

Status SceneOnGpu::set(const Scene& scene, const Tree* tree) {
  // Pack and upload into new objects; the previous scene stays if anything fails.
  GLint most_rows = 0;
  gl_->GetIntegerv(GL_MAX_TEXTURE_SIZE, &most_rows);
  Result<SceneTextures> packed = pack_scene(scene, tree, most_rows);
  if (!packed) return packed.error();
  while (gl_->GetError() != GL_NO_ERROR) {
  }
  std::array<GLuint, 5> textures{};
  gl_->ActiveTexture(GL_TEXTURE0);
  gl_->PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  const auto make = [&](std::size_t i, const auto& texels) {
    textures[i] = make_texture(*gl_);
    upload(*gl_, texels);
  };
  make(0, packed->spheres);
  make(1, packed->sphere_info);
  make(2, packed->nodes);
  make(3, packed->looks);
  make(kLights, packed->lights);
  gl_->BindTexture(GL_TEXTURE_2D, 0);
  Status status = Done{};
  if (gl_->GetError() != GL_NO_ERROR)
    status = Error{"the graphics processor has no room for " + std::to_string(scene.spheres.size()) + " spheres", "", 0,
                   0, "choose an engine of the CPU"};

  // Link the program of the shaded view now: if a driver refuses it, the scene is refused.
  const bool had_tree = std::exchange(has_tree_, tree != nullptr);
  const int had_stack = std::exchange(stack_size_, rounded_up(packed->most_waiting, 8));
  if (status)
    if (const Result<GlProgram*> shaded = program_for(View::shaded, 5, false, false); !shaded) status = shaded.error();
  if (!status) {
    gl_->DeleteTextures(GLsizei(textures.size()), textures.data());
    has_tree_ = had_tree;
    stack_size_ = had_stack;
    return status;
  }
  if (is_set()) gl_->DeleteTextures(GLsizei(textures_.size()), textures_.data());
  textures_ = textures;
  uniforms_ = SceneUniforms(scene, tree, *packed);
  scale_ = scene.spheres.scale();
  origin_ = scene.spheres.origin();
  has_soft_light_ = bihive::has_soft_light(scene);
  lets_light_through_ = bihive::lets_light_through(scene);
  is_passed_straight_ = has_bands_ = false;
  for (std::int64_t look = 0; look < packed->look_count; ++look) {
    const Material material = unpack_look(*packed, look);
    is_passed_straight_ = is_passed_straight_ || (look > 0 && bihive::is_passed_straight(material));
    has_bands_ = has_bands_ || material.bands > 0;
  }
  has_own_lines_ = bihive::has_own_lines(scene);
  const SphereAttributes& attributes = scene.spheres.attributes();
  has_creases_ = !attributes.crease.empty();
  widest_outline_px_ = 0;
  for (const float width : attributes.outline_px) widest_outline_px_ = std::max(widest_outline_px_, width);
  centres_and_radii_ = std::move(packed->spheres.channels);
  centres_and_radii_.resize(static_cast<std::size_t>(4 * packed->sphere_count));
  return Done{};
}

Status SceneOnGpu::set_lights(const Scene& scene) {
  GLint most_rows = 0;
  gl_->GetIntegerv(GL_MAX_TEXTURE_SIZE, &most_rows);
  const Result<SceneTextures> packed = pack_lights(scene, most_rows);
  if (!packed) return packed.error();
  gl_->ActiveTexture(GL_TEXTURE0);
  gl_->PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  gl_->BindTexture(GL_TEXTURE_2D, textures_[kLights]);
  upload(*gl_, packed->lights);
  gl_->BindTexture(GL_TEXTURE_2D, 0);
  uniforms_.light_count = static_cast<int>(packed->light_count);
  has_soft_light_ = bihive::has_soft_light(scene);
  return Done{};
}

void SceneOnGpu::destroy() {
  if (is_set()) gl_->DeleteTextures(GLsizei(textures_.size()), textures_.data());
  textures_ = {};
  for (auto& [name, program] : programs_) program.destroy();
  programs_.clear();
}

Result<GlProgram*> SceneOnGpu::program(const std::string& chunk, std::vector<std::string> defines) {
  if (has_tree_) defines.insert(defines.begin(), {"TREE", "STACK_SIZE " + std::to_string(stack_size_)});
  if (film_of_bits_) defines.emplace_back("FILM_OF_BITS");
  std::string name = chunk;
  for (const std::string& define : defines) name += " " + define;
  const auto known = programs_.find(name);
  if (known != programs_.end()) return &known->second;
  Result<GlProgram> linked = GlProgram::link(*gl_, chunk, defines);
  if (!linked) return linked.error();
  return &programs_.emplace(name, std::move(*linked)).first->second;
}

Result<GlProgram*> SceneOnGpu::program_for(View view, int recursion, bool layers, bool ambient) {
  // Each generation except the last two may leave one ray waiting; one size for recursion 1 to 6, one for 7 to 16.
  std::vector<std::string> defines{recursion <= 6 ? "PENDING_RAYS 6" : "PENDING_RAYS 16"};
  if (layers) defines.emplace_back("LAYERS");
  if (ambient) defines.emplace_back("AMBIENT_OCCLUSION");
  switch (view) {
    case View::shaded:
      return program("view_shaded", defines);
    case View::recursion:
      return program("view_recursion", defines);
    case View::traversal:
      return program("view_traversal", {"COUNTING"});
    case View::normal:
    case View::distance:
    case View::id:
    case View::tree:  // not drawn here
      break;
  }
  return program("view_first_hit", {});
}

Result<GlProgram*> SceneOnGpu::program_for_distance_range() {
  return program("distance_range", {});
}

Result<GlProgram*> SceneOnGpu::program_for_first_hits(bool layers) {
  return program("first_hits", layers ? std::vector<std::string>{"LAYERS"} : std::vector<std::string>{});
}

Result<GlProgram*> SceneOnGpu::program_for_coverage(bool layers) {
  return program("coverage", layers ? std::vector<std::string>{"LAYERS"} : std::vector<std::string>{});
}

std::pair<double, double> SceneOnGpu::depths(Vec3d eye, Vec3d forward) const {
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0;
  const Vec3d stored_eye = eye * scale_;
  for (std::size_t i = 0; i < centres_and_radii_.size(); i += 4) {
    const float* const sphere = &centres_and_radii_[i];
    const Vec3d centre{double(sphere[0]), double(sphere[1]), double(sphere[2])};
    const double depth = dot(centre - stored_eye, forward);
    nearest = std::min(nearest, depth - double(sphere[3]));
    farthest = std::max(farthest, depth + double(sphere[3]));
  }
  return {std::min(std::max(nearest, 0.0), farthest), farthest};
}

void SceneOnGpu::put(GlProgram& program) const {
  for (std::size_t i = 0; i < textures_.size(); ++i) {
    const int unit = kFirstUnit + static_cast<int>(i);
    gl_->ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    gl_->BindTexture(GL_TEXTURE_2D, textures_[i]);
    program.set(kSamplers[i], unit);
  }
  gl_->ActiveTexture(GL_TEXTURE0);
  uniforms_.put(program);
}

}  // namespace bihive
