// Whitted's pictures on a graphics processor: OpenGL ES 3.00, a window's or the browser's, or none but a context.
//
// One fragment shader traces a pixel: the reference tree by an explicit stack, binary32 throughout, both reflected and
// transmitted rays by a second stack of at most recursion + 1 pending rays (gl/shaders). The picture is made in passes,
// one sample of every pixel each, and a pass in tiles, so that no draw call takes long and whoever shows the picture
// may stop in between. Colours agree with the CPU's within a tolerance (docs/gpu.md), not bit for bit.
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

/// All calls, the destructor too, must find the same context current as create() did; when that context is lost, call
/// abandon() and create another renderer. Not to be used from two threads.
class GlRenderer {
 public:
  /// Error: the context is too old, or cannot draw into textures of 128 bits a texel.
  static Result<GlRenderer> create(const GlFunctions& functions);
  GlRenderer(GlRenderer&& other) noexcept;
  GlRenderer& operator=(GlRenderer&& other) noexcept;
  ~GlRenderer();

  /// Packs and uploads the spheres, their looks, plane, lights and background; with `tree` (of these very spheres) rays
  /// walk it, without (null) every sphere is tested: the thesis's brute force. Nothing of either is kept. Ends a
  /// picture that was begun. Error: more spheres or nodes than the context's textures hold, or the shader is refused;
  /// the scene before stays.
  Status set_scene(const Scene& scene, const Tree* tree);

  /// Takes the lights anew, for a light that goes along with the camera; everything else is as set_scene() took it.
  /// Ends a picture that was begun. Error: more lights than a texture holds.
  Status set_lights(const Scene& scene);

  /// Starts a picture. Settings as for render() (render/renderer.h; threads mean nothing), but View::tree is an Error,
  /// and View::traversal one where there is no tree. A scene must have been set.
  Status begin(const Camera& camera, const RenderSettings& settings);

  /// Draws tiles until about `budget_ms` have passed, at least one. Waits for the processor to be done with them.
  Status advance(double budget_ms);

  bool finished() const;
  double done() const;       ///< share of the whole picture, 0 to 1
  int samples_done() const;  ///< passes that every pixel has been through

  /// Draws the picture so far, stretched to the viewport; the transfer applies to View::shaded. Before the first pass
  /// is complete, pixels not yet drawn are the background's.
  void show(std::uint32_t framebuffer, const GlViewport& viewport, Transfer transfer);

  /// The finished picture and the number of rays: `primary`, and the others added up as `others`.
  struct Picture {
    Film film;
    std::int64_t primary = 0, others = 0;
  };
  Result<Picture> read();

  /// "Mesa, llvmpipe (LLVM 15), OpenGL ES 3.2": for reports.
  std::string description() const;

  /// The context is gone: forget its objects without asking it to delete them.
  void abandon();

 private:
  class Implementation;
  explicit GlRenderer(std::unique_ptr<Implementation> implementation);
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace bihive
