#include "bihive/viewer/scene_trees.h"

#include "bihive/render/memory.h"
#include "bihive/scene/clips.h"

namespace bihive {

// The wide tree of whole spheres alone.
Result<const BuiltWideTree*> SceneTrees::built() {
  if (!built_) {
    if (Status status = check_tree_memory(scene_.spheres, Engine::wide, parameters_); !status) return status.error();
    Result<BuiltWideTree> built = build_wide_tree(scene_.spheres, parameters_);
    if (!built) return built.error();
    built_ = std::move(*built);
  }
  return &*built_;
}

Result<const Tracer*> SceneTrees::wide() {
  if (wide_) return &*wide_;
  if (has_clips(scene_) || scene_.spheres.has_images() || !scene_.sticks.empty() || scene_.cavity_walls != nullptr) {
    Result<Tracer> tracer = Tracer::build(scene_, Engine::wide, parameters_);
    if (!tracer) return tracer.error();
    wide_ = std::move(*tracer);
    return &*wide_;
  }
  if (Result<const BuiltWideTree*> tree = built(); !tree) return tree.error();
  wide_.emplace(scene_.spheres, built_->tree);
  return &*wide_;
}

Result<const Tracer*> SceneTrees::reference() {
  if (!reference_) {
    if (Status status = check_tree_memory(scene_.spheres, Engine::reference, parameters_); !status)
      return status.error();
    Result<Tracer> built = Tracer::build(scene_.spheres, Engine::reference, parameters_);
    if (!built) return built.error();
    reference_ = std::move(*built);
  }
  return &*reference_;
}

const Tracer* SceneTrees::any() const {
  if (wide_) return &*wide_;
  return reference_ ? &*reference_ : nullptr;
}

Result<std::vector<workbench::StructurePath>> SceneTrees::paths_of(const Ray& ray) {
  const Result<const BuiltWideTree*> wide = built();
  if (!wide) return wide.error();
  const Result<const Tracer*> tracer = reference();
  if (!tracer) return tracer.error();
  return std::vector{workbench::path_of_ray(scene_.spheres, *(*wide)->tree, ray),
                     workbench::path_of_ray(scene_.spheres, *(*tracer)->tree(), ray)};
}

Result<std::string> SceneTrees::statistics(std::optional<std::uint64_t> seed) {
  if (Result<const BuiltWideTree*> tree = built(); !tree) return tree.error();
  const Result<const Tracer*> tracer = reference();
  if (!tracer) return tracer.error();
  return statistics_json(reference_facts(*(*tracer)->tree(), (*tracer)->build_ms()), wide_facts(*built_), seed);
}

}  // namespace bihive
