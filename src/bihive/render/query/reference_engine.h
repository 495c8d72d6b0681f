// The reference engine: scalar traversal of the reference tree (bih/traversal.h).
#pragma once

#include <memory>
#include <utility>

#include "bihive/bih/traversal.h"
#include "bihive/render/query/ray_engine.h"

namespace bihive {

class ReferenceEngine final : public OneByOne<ReferenceEngine> {
 public:
  /// The spheres must outlive it.
  ReferenceEngine(const SphereSet& spheres, std::shared_ptr<const Tree> tree)
      : spheres_(spheres), tree_(std::move(tree)) {}

  using OneByOne::occluded;
  Hit closest_hit(const Ray& ray) const override { return bihive::closest_hit(*tree_, spheres_, ray); }
  bool occluded(const Ray& ray) const override { return bihive::occluded(*tree_, spheres_, ray); }
  void find_all(const Ray& ray, AllHits& all) const {
    NoObserver observer;
    walk(*tree_, spheres_, ScaledRay(ray, spheres_), all, observer);
  }
  const Tree* tree() const override { return tree_.get(); }

 private:
  const SphereSet& spheres_;
  std::shared_ptr<const Tree> tree_;
};

}  // namespace bihive
