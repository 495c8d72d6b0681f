// Pictures of the graphics processor, and the last one kept to be shown while the next is made.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "bihive/base/result.h"
#include "bihive/gl/functions.h"
#include "bihive/gl/gl_renderer.h"
#include "bihive/image/image.h"
#include "bihive/scene/render_settings.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// The rules of GlRenderer for contexts hold here too.
class GpuPictures {
 public:
  /// Error: the context cannot do it.
  static Result<std::unique_ptr<GpuPictures>> create(const GlFunctions& functions);
  virtual ~GpuPictures() = default;

  /// As GlRenderer::set_scene(). Error: the scene before stays.
  virtual Status set_scene(const Scene& scene, const Tree& tree) = 0;
  /// Other lights for the same scene.
  virtual Status set_lights(const Scene& scene, const Tree& tree) = 0;

  /// Starts a picture with the scene's camera and transfer.
  virtual Status begin(const Scene& scene, const RenderSettings& settings) = 0;
  virtual Status advance(double budget_ms) = 0;
  virtual bool finished() const = 0;
  virtual double done() const = 0;
  virtual int samples_done() const = 0;

  /// Keeps what has been drawn so far as the picture that show() draws.
  virtual void keep() = 0;
  virtual void show(std::uint32_t framebuffer, const GlViewport& viewport) = 0;

  /// The finished picture.
  virtual Result<GlRenderer::Picture> read() = 0;

  virtual std::string description() const = 0;
  /// The context is gone: nothing is to be deleted.
  virtual void abandon() = 0;
};

}  // namespace bihive
