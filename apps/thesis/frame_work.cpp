#include "frame_work.h"

#include <algorithm>

#include "bihive/bih/reference_builder.h"
#include "bihive/thesis/figure_costs.h"

namespace bihive::thesis {

FigurePicture counted_picture(const StepContext& context) {
  FigurePicture picture;
  picture.seed = context.settings.seed;
  picture.radius = context.values.number("radius");
  const auto side = [&](const char* name) {
    return static_cast<int>(std::clamp<std::int64_t>(context.values.integer(name), 1, 65535));
  };
  picture.width_px = side("width_px");
  picture.height_px = side("height_px");
  return picture;
}

Json count_work(const StepContext& context, std::int64_t scenario, const FigurePicture& picture,
                const std::vector<std::int64_t>& max_prims, bool one_leaf) {
  Json rows = Json::array();
  for (const std::int64_t spheres : context.values.integers("spheres_list")) {
    const ScenarioParameters parameters{spheres, static_cast<float>(picture.radius), picture.seed};
    Scene scene = cli::value_or_fail(scenario_scene(scenario_of(scenario), parameters));
    scene.camera.fov_deg = picture.fov_deg;
    std::vector<std::int64_t> limits;
    std::copy_if(max_prims.begin(), max_prims.end(), std::back_inserter(limits),
                 [&](std::int64_t limit) { return limit < spheres; });
    if (one_leaf) limits.push_back(spheres);
    for (const std::int64_t limit : limits) {
      const Tree tree = build_reference_tree(scene.spheres, {limit, kUnlimited});
      const std::optional<RayWork> work =
          counted_work(scene, tree, {picture.width_px, picture.height_px, picture.stride}, context.settings.threads,
                       &context.cancel);
      if (!work) return {};
      rows.push_back({{"scenario", scenario},
                      {"spheres", spheres},
                      {"max_prims", limit},
                      {"inner", work->inner},
                      {"leaves", work->leaves},
                      {"tests", work->tests}});
    }
  }
  return rows;
}

void add_work(const Json& rows, FigureWork& work) {
  for (const Json& row : rows)
    work[{row["scenario"].get<std::int64_t>(), row["spheres"].get<std::int64_t>()}]
        [row["max_prims"].get<std::int64_t>()] = {row["inner"].get<double>(), row["leaves"].get<double>(),
                                                  row["tests"].get<double>()};
}

}  // namespace bihive::thesis
