#include "bihive/viewer/scene_trees.h"

#include "bihive/render/memory.h"

namespace bihive {

Result<const Tracer*> SceneTrees::wide() {
  if (!wide_) {
    if (Status status = check_tree_memory(spheres_, Engine::wide, parameters_); !status) return status.error();
    Result<BuiltWideTree> built = build_wide_tree(spheres_, parameters_);
    if (!built) return built.error();
    built_ = std::move(*built);
    wide_.emplace(spheres_, built_->tree);
  }
  return &*wide_;
}

Result<const Tracer*> SceneTrees::reference() {
  if (!reference_) {
    if (Status status = check_tree_memory(spheres_, Engine::reference, parameters_); !status) return status.error();
    Result<Tracer> built = Tracer::build(spheres_, Engine::reference, parameters_);
    if (!built) return built.error();
    reference_ = std::move(*built);
  }
  return &*reference_;
}

const Tracer* SceneTrees::any() const {
  if (wide_) return &*wide_;
  return reference_ ? &*reference_ : nullptr;
}

Result<std::string> SceneTrees::statistics(std::optional<std::uint64_t> seed) {
  if (Result<const Tracer*> tracer = wide(); !tracer) return tracer.error();
  const Result<const Tracer*> tracer = reference();
  if (!tracer) return tracer.error();
  return statistics_json(reference_facts(*(*tracer)->tree(), (*tracer)->build_ms()), wide_facts(*built_), seed);
}

}  // namespace bihive
