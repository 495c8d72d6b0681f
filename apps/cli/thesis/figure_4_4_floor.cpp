// Frames with bytes in memory, by the engine wide as a user has it: a check of our own beside the text's 60 frames a
// second.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "bihive/base/timer.h"
#include "bihive/image/film.h"
#include "bihive/render/renderer.h"
#include "bihive/scene/generators.h"
#include "bihive/simd/target.h"
#include "support/failure.h"
#include "thesis/figure_4_4.h"
#include "thesis/pictures.h"

namespace bihive::cli::thesis {
namespace {

constexpr int kFloorRounds = 9;       // a first one besides, which warms up
constexpr double kFloorRoundMs = 60;  // of several frames, so that a single moment does not decide
constexpr int kQuickFloorRounds = 2;

// "avx512" or "avx2" on the vectors that have a floor; else empty.
std::string vectors_with_a_floor() {
  const std::string target = active_target();
  if (target.rfind("avx512", 0) == 0) return "avx512";
  return target == "avx2" ? target : "";
}

// Milliseconds of a frame, a round each: rays, hits, shading, bytes.
std::vector<double> frame_ms(const StepContext& context, const Scene& scene, const PictureSize& size) {
  RenderSettings settings = settings_from(scene.picture);
  settings.width_px = size.width_px;
  settings.height_px = size.height_px;
  settings.recursion = 1;
  settings.threads = context.settings.threads;
  const Tracer tracer = value_or_fail(Tracer::build(scene.spheres, Engine::automatic));
  std::vector<double> rounds;
  Film film;
  for (int round = -1; round < (context.settings.quick ? kQuickFloorRounds : kFloorRounds); ++round) {
    const Timer timer;
    int frames = 0;
    for (; frames == 0 || timer.elapsed_ms() < kFloorRoundMs; ++frames) {
      Result<Rendered> rendered = render(scene, tracer, settings, {}, &context.cancel, std::move(film));
      if (context.cancel.cancelled()) return {};
      if (!rendered) fail(rendered.error());
      film = std::move(rendered->film);
      image_from_film(film, settings.view, scene.picture.transfer, settings.threads);
    }
    if (round >= 0) rounds.push_back(timer.elapsed_ms() / frames);
  }
  return rounds;
}

}  // namespace

Json measure_frames_in_memory(const StepContext& context) {
  const Values& values = context.values;
  const PictureSize size = picture_size(Settings{}, values, 1);
  Json configurations = Json::array();
  for (const std::int64_t scenario : values.integers("scenarios"))
    for (const std::int64_t spheres : values.integers("spheres_list")) {
      const ScenarioParameters parameters{spheres, static_cast<float>(values.number("radius")), context.settings.seed};
      const Scene scene = value_or_fail(scenario_scene(scenario_of(scenario), parameters));
      std::vector<double> rounds = frame_ms(context, scene, size);
      if (rounds.empty()) return {};
      configurations.push_back({{"scenario", scenario}, {"spheres", spheres}, {"frame_ms", std::move(rounds)}});
    }
  return {{"vectors", active_target()},
          {"floor", vectors_with_a_floor()},
          {"width_px", size.width_px},
          {"height_px", size.height_px},
          {"configurations", std::move(configurations)}};
}

void add_floor(const SectionContext& context, Section& section) {
  const auto found = context.results.find(kFloorStep);
  if (found == context.results.end()) return;
  const Values& values = context.values;
  const Json& measured = found->second;
  const std::string name = "floor.fps." + measured["floor"].get<std::string>();
  if (!values.has(name)) return;
  const double floor = values.number(name);

  Statements statements(
      fmt::format("Frames a second with bytes in memory, by the engine wide ({})",
                  measured["vectors"].get<std::string>()),
      fmt::format("{} x {} pixels, primary rays, this engine's own tree with the parameters that a user gets, on all "
                  "threads, from the rays to the bytes of the picture. A check of ours: at least {:.0f} on these "
                  "vectors and two processors. The medians of the rounds, with their quartiles.",
                  measured["width_px"].get<int>(), measured["height_px"].get<int>(), floor));
  for (const Json& one : measured["configurations"]) {
    const Quartiles fps = fps_quartiles(one["frame_ms"].get<std::vector<double>>());
    const auto scenario = one["scenario"].get<std::int64_t>(), spheres = one["spheres"].get<std::int64_t>();
    statements.add(fmt::format("floor.scenario{}.spheres{}", scenario, spheres),
                   fmt::format("Scenario {}, {} spheres", scenario, spheres),
                   {fmt::format("at least {:.0f}", floor), values.kind(name)}, quartiles_text(fps, 0),
                   verdict_above(fps, floor), "", /*timed=*/true);
  }
  section.data["frames_in_memory"] = measured;
  Section part;
  part.title = "Real time: frames with bytes";
  statements.move_into(section);
  part.tables.push_back(std::move(section.tables.back()));
  section.tables.pop_back();
  section.parts.push_back(std::move(part));
}

}  // namespace bihive::cli::thesis
