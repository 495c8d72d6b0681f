// bihive compare: several structures on the same spheres, by counted steps and by time.

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "bihive/compare/comparison.h"
#include "bihive/compare/comparison_json.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "bihive/scene/framing.h"
#include "bihive/simd/target.h"
#include "commands/commands.h"
#include "commands/compare_report.h"
#include "support/outputs.h"
#include "support/request_files.h"
#include "support/thread_reserve.h"
#include "support/write_together.h"

namespace bihive::cli {
namespace {

using workbench::Comparison;
using workbench::KindResult;
using workbench::StepStatistics;
using workbench::StructureResult;

std::string steps(const StepStatistics& statistics) {
  return short_number(statistics.mean) + " / " + grouped(std::llround(statistics.most_of_99));
}

std::string table_of_builds(const Comparison& comparison) {
  std::string text = fmt::format("{:<12}{:>12}{:>14}{:>8}{:>14}{:>14}\n", "structure", "build", "bytes/sphere",
                                 "levels", "nodes", "listed/sphere");
  for (const StructureResult& one : comparison.structures) {
    const auto spheres = static_cast<double>(comparison.spheres);
    text += fmt::format("{:<12}{:>12}{:>14}{:>8}{:>14}{:>14}\n", one.row.name, readable_ms(one.build_ms),
                        short_number(static_cast<double>(one.facts.bytes) / spheres), one.facts.depth,
                        grouped(one.facts.nodes), short_number(static_cast<double>(one.facts.references) / spheres));
  }
  return text;
}

std::string table_of_kind(const Comparison& comparison, std::size_t k) {
  const workbench::QueryKindRow& kind = workbench::row_of(comparison.kinds[k]);
  if (comparison.queries[k] == 0) return fmt::format("{}: none; no primary ray leads to one\n", kind.name);
  const bool points = kind.kind == workbench::QueryKind::points;
  std::string text =
      fmt::format("{}: {} {}; steps as mean / 99 %; correlation of expected and counted cost {}\n", kind.name,
                  grouped(comparison.queries[k]), points ? "points" : "rays", short_number(comparison.correlation[k]));
  text += fmt::format("{:<12}{:>10}{:>16}{:>18}{:>20}{:>10}{:>10}\n", "structure", points ? "M/s" : "Mray/s", "nodes",
                      "box tests", "sphere tests", "expected", "counted");
  for (const StructureResult& one : comparison.structures) {
    const KindResult& result = one.kinds[k];
    text += fmt::format("{:<12}{:>10}{:>16}{:>18}{:>20}{:>10}{:>10}", one.row.name, short_number(result.rate()),
                        steps(result.nodes), steps(result.box_tests), steps(result.sphere_tests),
                        short_number(one.facts.expected_cost()), short_number(result.cost));
    if (result.queries < comparison.queries[k]) text += fmt::format("  of {} alone", grouped(result.queries));
    text += "\n";
  }
  return text;
}

std::string text_of(const Comparison& comparison, const std::string& name) {
  std::string text = fmt::format("{}: {} sphere{}, {} thread{}, {}\n{}\n\n", escaped(name), grouped(comparison.spheres),
                                 comparison.spheres == 1 ? "" : "s", comparison.threads,
                                 comparison.threads == 1 ? "" : "s", active_target(), answer_of(comparison));
  text += table_of_builds(comparison);
  for (std::size_t k = 0; k < comparison.kinds.size(); ++k) text += "\n" + table_of_kind(comparison, k);
  if (comparison.same_bits()) text += "\nEvery answer has the bits of the reference BIH.\n";
  return text;
}

// A camera and a light for spheres without.
void complete(Input& input) {
  Scene& scene = input.scene;
  if (!input.has_camera) {
    constexpr int kSide = 256;  // of any square picture
    scene.camera = frame_spheres(scene.spheres, ViewFrom::front, scene.camera.fov_deg, kSide, kSide);
  }
  if (!input.has_lights || scene.lights.empty()) scene.lights = {light_behind(scene.camera)};
  if (!scene.clips.empty() || scene.sticks.total_size(scene.spheres) > 0)
    warn("structures are built from whole spheres: clips and sticks do not count");
}

// A structure that answers wrongly is a fault of this program.
void fail_if_different(const Comparison& comparison) {
  for (const StructureResult& one : comparison.structures)
    for (const KindResult& kind : one.kinds)
      if (kind.different > 0)
        fail({fmt::format("{} answers {} of {} queries ({}) with other bits than the reference BIH", one.row.name,
                          grouped(kind.different), grouped(kind.queries), workbench::row_of(kind.kind).name),
              "", 0, 0, "please report it, with the input"});
}

}  // namespace

void run_compare(const CompareOptions& options) {
  refuse_copies(options.input, "structures are built from the stored spheres");
  if (options.json && on_standard_output(outputs_of(options)))
    fail_usage("--json and a report on - would share the standard output");
  check_outputs(outputs_of(options), inputs_of(options), /*are_text=*/true);
  Input input = load_input(options.input);
  check_outputs(outputs_of(options), input.files, /*are_text=*/true);
  complete(input);
  renew_group_limit_for_threads(options.threads);

  workbench::ComparisonOptions wanted;
  wanted.structures = options.structures;
  wanted.kinds = options.kinds;
  wanted.count = options.count;
  wanted.threads = static_cast<int>(options.threads);
  Comparison comparison;
  {
    Progress progress("comparing");
    wanted.progress = [&progress](double done) { progress.update(done); };
    comparison = value_or_fail(workbench::compare_structures(input.scene, wanted));
  }
  if (!options.output.empty()) {
    const std::string html = comparison_html(comparison, input.scene.name);
    write_together({{output_path(options.output), html}});
  }
  if (options.json)
    print(workbench::comparison_json(comparison, input.scene.name) + "\n");
  else
    print_report(text_of(comparison, input.scene.name), outputs_of(options));
  fail_if_different(comparison);
}

}  // namespace bihive::cli
