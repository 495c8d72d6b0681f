// The trees of one scene, built at their first use and kept.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/compare/ray_path.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/scene.h"
#include "bihive/viewer/statistics_json.h"
#include "bihive/viewer/viewer_settings.h"

namespace bihive {

class SceneTrees {
 public:
  /// The scene must outlive it, and its spheres and clips must not change.
  SceneTrees(const Scene& scene, const TreeParameters& parameters) : scene_(scene), parameters_(parameters) {}

  /// Error: not enough memory, or too many spheres. The tracers live as long as this object. The reference tree is that
  /// of whole spheres: for pictures of the tree and for GPUs, which draw no cut ones.
  Result<const Tracer*> wide();
  Result<const Tracer*> reference();
  /// The tracer that these settings need.
  Result<const Tracer*> needed_by(const ViewerSettings& settings) {
    return needs_reference_tree(settings) ? reference() : wide();
  }
  /// Any tracer that exists already, for single rays; null if there is none.
  const Tracer* any() const;

  /// The way of a ray through the trees of whole spheres, the wide one first. Errors as above.
  Result<std::vector<workbench::StructurePath>> paths_of(const Ray& ray);

  /// Errors as above.
  Result<std::string> statistics(std::optional<std::uint64_t> seed);

 private:
  Result<const BuiltWideTree*> built();

  const Scene& scene_;
  TreeParameters parameters_;
  std::optional<BuiltWideTree> built_;
  std::optional<Tracer> wide_, reference_;
};

}  // namespace bihive
