#include "bihive/job/tuned_tree.h"

#include <fmt/format.h>

#include <optional>
#include <utility>
#include <vector>

#include "bihive/base/setting_name.h"
#include "bihive/compare/sweep.h"
#include "bihive/compare/tune.h"
#include "bihive/job/failure.h"
#include "bihive/scene/names.h"

namespace bihive {

std::string TunedTree::text() const {
  std::string chosen;
  const auto add = [&](const char* id, const std::optional<std::int64_t>& value) {
    if (value) chosen += (chosen.empty() ? "" : ", ") + setting_name(id) + fmt::format(" {}", *value);
  };
  add("max_prims", tree.max_prims);
  add("max_depth", tree.max_depth);
  if (chosen.empty()) return "no other tree is faster than the engine's own choice";
  if (gain <= 1 + workbench::kAsGood)
    return chosen + ": as fast by the clock as the engine's own choice, and faster by counted steps";
  return fmt::format("{}: {:.3g} times as fast as the engine's own choice", chosen, gain);
}

namespace {

TunedTree tuned(const Scene& scene, Engine engine, std::vector<workbench::QueryKind> kinds, int threads,
                const ProgressCallback& progress) {
  if (scene.spheres.empty()) return {};
  workbench::TuneOptions options;
  options.structure = engine == Engine::reference ? "bih" : "wide";
  options.kinds = std::move(kinds);
  options.threads = threads;
  options.progress = progress;
  const workbench::Tuning tuning = value_or_fail(workbench::tune_structure(scene, options));
  TunedTree found;
  found.gain = tuning.gain();
  const workbench::StructureParameters& best = tuning.best.parameters;
  if (best.max_prims > 0) found.tree.max_prims = best.max_prims;
  if (best.max_depth > 0) found.tree.max_depth = best.max_depth;
  return found;
}

}  // namespace

void check_tuning(const TreeParameters& given, const std::string& engine, bool has_tree) {
  if (given.max_prims || given.max_depth)
    fail_setting("tune", " searches " + setting_name("max_prims") + " and " + setting_name("max_depth"),
                 "leave " + setting_name("tune") + " or these out");
  if (!has_tree)
    fail_setting("tune", " needs a tree on the processor, and " + setting_name("engine") + " " + engine + " has none",
                 "leave " + setting_name("engine") + " out");
}

void check_tuned_view(View view) {
  if (view == View::traversal || view == View::tree)
    fail_setting("tune", " would change what " + setting_name("view") + " " + name_of(kViews, view) + " shows");
}

TunedTree tuned_tree(const Scene& scene, RenderEngine engine, const RenderSettings& settings,
                     const ProgressCallback& progress) {
  std::vector<workbench::QueryKind> kinds{workbench::QueryKind::primary};
  if (settings.shadows) kinds.push_back(workbench::QueryKind::shadow);
  if (settings.ambient_occlusion) kinds.push_back(workbench::QueryKind::ao);
  return tuned(scene, structure_of(engine), std::move(kinds), settings.threads, progress);
}

TunedTree tuned_tree_for_rays(const SphereSet& spheres, Engine engine, int threads, const ProgressCallback& progress) {
  Scene scene;
  scene.spheres = spheres;
  workbench::complete_for_queries(scene, /*has_camera=*/false, /*has_lights=*/false);
  return tuned(scene, engine, {workbench::QueryKind::random}, threads, progress);
}

TreeParameters tree_for(const PictureRequest& request, RenderEngine engine, const Scene& scene,
                        const RenderSettings& settings) {
  return request.tune ? tuned_tree(scene, engine, settings).tree : request.tree;
}

}  // namespace bihive
