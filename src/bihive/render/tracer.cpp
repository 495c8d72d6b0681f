#include "bihive/render/tracer.h"

#include "bihive/base/timer.h"
#include "bihive/bih/traversal.h"
#include "bihive/render/brute_force.h"

namespace bihive {

Tracer::Tracer(const SphereSet& spheres, Engine engine, const BuildParameters& parameters)
    : spheres_(&spheres), engine_(engine == Engine::automatic ? Engine::reference : engine) {
  if (engine_ == Engine::brute) return;
  const Timer timer;
  tree_ = build_reference_tree(spheres, parameters);
  build_ms_ = timer.elapsed_ms();
}

Hit Tracer::closest_hit(const Ray& ray) const {
  return tree_ ? bihive::closest_hit(*tree_, *spheres_, ray) : bihive::closest_hit(*spheres_, ray);
}

bool Tracer::occluded(const Ray& ray) const {
  return tree_ ? bihive::occluded(*tree_, *spheres_, ray) : bihive::occluded(*spheres_, ray);
}

}  // namespace bihive
