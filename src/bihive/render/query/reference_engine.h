// The reference engine: scalar traversal of the reference tree (bih/traversal.h).
#pragma once

#include <memory>
#include <utility>

#include "bihive/bih/traversal.h"
#include "bihive/render/query/ray_engine.h"

namespace bihive {

/// Its queries are flattened: else it would depend on the other functions of the source file whether GCC inlines the
/// sphere test into the traversal, and the difference is a fifth of the instructions.
class ReferenceEngine final : public OneByOne<ReferenceEngine> {
 public:
  /// The spheres must outlive it.
  ReferenceEngine(const SphereSet& spheres, std::shared_ptr<const Tree> tree)
      : spheres_(spheres), tree_(std::move(tree)) {}

  using OneByOne::occluded;
  [[gnu::flatten]] Hit closest_hit(const Ray& ray) const override { return bihive::closest_hit(*tree_, spheres_, ray); }
  [[gnu::flatten]] bool occluded(const Ray& ray) const override { return bihive::occluded(*tree_, spheres_, ray); }
  [[gnu::flatten]] void find_all(const Ray& ray, AllHits& all) const {
    NoObserver observer;
    walk(*tree_, spheres_, ScaledRay(ray, spheres_), all, observer);
  }
  const Tree* tree() const override { return tree_.get(); }

 private:
  const SphereSet& spheres_;
  std::shared_ptr<const Tree> tree_;
};

}  // namespace bihive
