// Whitted's pictures on a graphics processor by OpenGL ES 3.00, in a window, in a browser, or without either.
//
// One fragment shader traces a pixel. It traverses the reference tree with an explicit stack, in binary32, and follows
// reflected and transmitted rays with a second stack of at most recursion + 1 pending rays (gl/shaders). The picture is
// drawn in passes of one sample per pixel, the light of a sample in slices (gl/light_slices.h), and both in tiles. So
// no draw call takes long, and the caller may stop in between. Colours agree with the CPU's within a tolerance
// (docs/gpu.md), not bit for bit.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "bihive/base/result.h"
#include "bihive/bih/tree.h"
#include "bihive/gl/functions.h"
#include "bihive/image/film.h"
#include "bihive/image/transfer.h"
#include "bihive/scene/render_settings.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// A rectangle of a framebuffer in pixels, from its lower left corner as OpenGL counts.
struct GlViewport {
  int x, y, width, height;
};

/// All calls, the destructor too, need the context of create() to be current. If that context is lost, call abandon()
/// and create another renderer. Not to be used from two threads.
class GlRenderer {
 public:
  /// Error: the context is too old, or cannot draw into textures of 128 bits per texel.
  static Result<GlRenderer> create(const GlFunctions& functions);
  GlRenderer(GlRenderer&& other) noexcept;
  GlRenderer& operator=(GlRenderer&& other) noexcept;
  ~GlRenderer();

  /// Packs and uploads the spheres, their materials, plane, lights and background. With `tree` (of these spheres) rays
  /// traverse it. Without it (null) every sphere is tested: the thesis's brute force. The renderer keeps neither scene
  /// nor tree, but 16 bytes per sphere. Ends a picture that was begun. Error: clips cut some sphere, more spheres or
  /// nodes than the context's textures hold, or the shader is refused; the scene before stays.
  Status set_scene(const Scene& scene, const Tree* tree);

  /// Uploads new lights, for a light that moves with the camera; everything else stays as in set_scene(). Ends a
  /// picture that was begun. Error: more lights than a texture holds.
  Status set_lights(const Scene& scene);

  /// Starts a picture. Settings as for render() (render/renderer.h) without `threads`. Errors: View::tree,
  /// View::traversal without a tree or on a transparent background, and in View::shaded adaptive samples and edges of a
  /// cell. A scene must have been set.
  Status begin(const Camera& camera, const RenderSettings& settings);

  /// Draws tiles until about `budget_ms` have passed, at least one tile. Waits until the GPU has drawn them.
  Status advance(double budget_ms);

  bool finished() const;
  double done() const;       ///< share of the whole picture, 0 to 1; it never falls
  int samples_done() const;  ///< passes that are complete for every pixel

  /// Draws the unfinished picture, stretched to the viewport; the transfer applies to View::shaded. Before the first
  /// pass is complete, pixels not yet drawn are the background's. A transparent background shows grey checks; without
  /// `checks` the framebuffer gets opacity, and colours multiplied by it.
  void show(std::uint32_t framebuffer, const GlViewport& viewport, Transfer transfer, bool checks = true);

  /// The finished picture, or its settings.crop, and the numbers of rays: `primary`, and all others as `others`. Error:
  /// the driver has stopped the work of a pixel.
  struct Picture {
    Film film;
    std::int64_t primary = 0, others = 0;
  };
  Result<Picture> read();

  /// "Mesa, llvmpipe (LLVM 15), OpenGL ES 3.2": for reports.
  std::string description() const;

  /// The context is gone: forgets its objects without deleting them.
  void abandon();

 private:
  class Implementation;
  explicit GlRenderer(std::unique_ptr<Implementation> implementation);
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace bihive
