// Tachyon as a peer, as a program: the same scene in its own language, and the time that it prints.
#pragma once

#include <string>

#include "bihive/base/result.h"
#include "bihive/render/renderer.h"
#include "bihive/scene/scene.h"

namespace bihive::bench {

class Tachyon {
 public:
  /// Writes the scene to `path`: spheres, plane (without its checker), lights (without radii), camera. Samples and
  /// ambient occlusion without a distance are those of `settings`; a surface has as many occlusion rays as the mean
  /// number of ours in front of it. Error: no such program, or the file cannot be written.
  static Result<Tachyon> start(const Scene& scene, const RenderSettings& settings, const std::string& path);

  /// Milliseconds of one picture, without reading the scene, making its grid, and writing a file. `picture`: the path
  /// of a PNG; empty: no file.
  Result<double> render_ms(const std::string& picture = "") const;

 private:
  std::string command_;
};

}  // namespace bihive::bench
