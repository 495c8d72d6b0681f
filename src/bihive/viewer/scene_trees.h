// The trees of one scene, built at their first use and kept.
#pragma once

#include <optional>
#include <string>

#include "bihive/base/result.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/render/tracer.h"
#include "bihive/viewer/statistics_json.h"
#include "bihive/viewer/viewer_settings.h"

namespace bihive {

class SceneTrees {
 public:
  /// The spheres must outlive it.
  SceneTrees(const SphereSet& spheres, const TreeParameters& parameters) : spheres_(spheres), parameters_(parameters) {}

  /// Error: not enough memory, or too many spheres. The tracers live as long as this object.
  Result<const Tracer*> wide();
  Result<const Tracer*> reference();
  /// The tracer that these settings need.
  Result<const Tracer*> needed_by(const ViewerSettings& settings) {
    return needs_reference_tree(settings) ? reference() : wide();
  }
  /// Any tracer that exists already, for single rays; null if there is none.
  const Tracer* any() const;

  /// Errors as above.
  Result<std::string> statistics(std::optional<std::uint64_t> seed);

 private:
  const SphereSet& spheres_;
  TreeParameters parameters_;
  std::optional<BuiltWideTree> built_;
  std::optional<Tracer> wide_, reference_;
};

}  // namespace bihive
