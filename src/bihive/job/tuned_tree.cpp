#include "bihive/job/tuned_tree.h"

#include <fmt/format.h>

#include <optional>
#include <vector>

#include "bihive/base/setting_name.h"
#include "bihive/compare/tune.h"
#include "bihive/job/failure.h"

namespace bihive {

std::string TunedTree::text() const {
  std::string chosen;
  const auto add = [&](const char* id, const std::optional<std::int64_t>& value) {
    if (value) chosen += (chosen.empty() ? "" : ", ") + setting_name(id) + fmt::format(" {}", *value);
  };
  add("max_prims", tree.max_prims);
  add("max_depth", tree.max_depth);
  if (chosen.empty()) return "no other tree is faster than the engine's own choice";
  return fmt::format("{}: {:.3g} times as fast as the engine's own choice", chosen, gain);
}

TunedTree tuned_tree(const Scene& scene, RenderEngine engine, const RenderSettings& settings,
                     const ProgressCallback& progress) {
  if (scene.spheres.empty()) return {};
  workbench::TuneOptions options;
  options.structure = structure_of(engine) == Engine::reference ? "bih" : "wide";
  options.kinds = {workbench::QueryKind::primary};
  if (settings.shadows) options.kinds.push_back(workbench::QueryKind::shadow);
  if (settings.ambient_occlusion) options.kinds.push_back(workbench::QueryKind::ao);
  options.threads = settings.threads;
  options.progress = progress;
  const workbench::Tuning tuning = value_or_fail(workbench::tune_structure(scene, options));
  TunedTree tuned;
  tuned.gain = tuning.gain();
  const workbench::StructureParameters& best = tuning.best.parameters;
  if (best.max_prims > 0) tuned.tree.max_prims = best.max_prims;
  if (best.max_depth > 0) tuned.tree.max_depth = best.max_depth;
  return tuned;
}

TreeParameters tree_for(const PictureRequest& request, RenderEngine engine, const Scene& scene,
                        const RenderSettings& settings) {
  return request.tune ? tuned_tree(scene, engine, settings).tree : request.tree;
}

}  // namespace bihive
