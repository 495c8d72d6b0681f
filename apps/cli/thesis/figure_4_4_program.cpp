// The thesis program's frames, and how many of its pixels are those of the reference engine.
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <map>

#include "bihive/bih/reference_builder.h"
#include "bihive/bih/traversal.h"
#include "bihive/scene/camera.h"
#include "bihive/scene/generators.h"
#include "bihive/thesis/thesis_program.h"
#include "support/failure.h"
#include "thesis/compare.h"
#include "thesis/figure_4_4.h"
#include "thesis/pictures.h"

namespace bihive::cli::thesis {
namespace {

// Rounds that count; one before them warms up.
constexpr int kRoundsOfProgram = 5, kQuickRoundsOfProgram = 3;
// Its pictures have a part of the width and height: the time of a ray does not depend on how many there are.
constexpr int kDivisor = 2, kQuickDivisor = 4;

// Processor time of this thread: the program has no other one, and work beside it on the machine does not count.
double thread_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

std::int64_t pixels_that_differ(const std::vector<std::int32_t>& ids, const Scene& scene, const Tree& tree, int width,
                                int height) {
  const PixelRays pixels(scene.camera, width, height);
  std::int64_t differ = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Hit hit = closest_hit(tree, scene.spheres, pixels.at(x + 0.5, y + 0.5));
      const std::int64_t expected = hit.found() ? hit.sphere_id : -1;
      if (expected != ids[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)])
        ++differ;
    }
  return differ;
}

}  // namespace

std::string program_step(std::int64_t scenario, std::int64_t spheres) {
  return fmt::format("program-scenario{}-spheres{}", scenario, spheres);
}

Json measure_program(const StepContext& context, std::int64_t scenario, std::int64_t spheres) {
  const Values& values = context.values;
  const ScenarioParameters parameters{spheres, static_cast<float>(values.number("radius")), context.settings.seed};
  const Scene scene = value_or_fail(scenario_scene(scenario_of(scenario), parameters));
  const PictureSize whole = picture_size(Settings{}, values, 1);
  const int divisor = context.settings.quick ? kQuickDivisor : kDivisor;
  const int width = std::max(1, whole.width_px / divisor), height = std::max(1, whole.height_px / divisor);

  // A tree of each MAX_PRIMS, and brute force, which needs none.
  std::map<std::int64_t, ThesisProgram> programs;
  std::map<std::int64_t, Tree> trees;
  for (const std::int64_t prims : values.integers("max_prims_list")) {
    trees[prims] = build_reference_tree(scene.spheres, {prims, kUnlimited});
    programs.emplace(prims, ThesisProgram(scene, trees[prims]));
  }

  Json times = {{"brute", Json::array()}};
  std::int64_t differ = 0;
  std::vector<std::int32_t> ids;
  for (int round = -1; round < (context.settings.quick ? kQuickRoundsOfProgram : kRoundsOfProgram); ++round) {
    const auto measure = [&](const std::string& name, const auto& draw) {
      const double before_ms = thread_ms();
      draw();
      if (round >= 0) times[name].push_back(thread_ms() - before_ms);
    };
    measure("brute", [&] { programs.begin()->second.draw_by_brute_force(width, height, ids); });
    for (const auto& each : programs) {  // clang 14 does not capture bindings
      const ThesisProgram& program = each.second;
      measure(fmt::format("max_prims{}", each.first), [&] { program.draw_by_tree(width, height, ids); });
      if (round < 0) differ = std::max(differ, pixels_that_differ(ids, scene, trees[each.first], width, height));
    }
    if (context.cancel.cancelled()) return {};
  }
  return {{"width_px", width}, {"height_px", height}, {"pixels_that_differ", differ}, {"frame_ms", std::move(times)}};
}

}  // namespace bihive::cli::thesis
