// bihive compare and bihive tune: structures and their parameters on the same spheres, by counted steps and by time.

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "bihive/base/parallel.h"
#include "bihive/compare/comparison.h"
#include "bihive/compare/comparison_json.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "bihive/job/selection.h"
#include "commands/commands.h"
#include "commands/compare_report.h"
#include "commands/compare_text.h"
#include "support/outputs.h"
#include "support/request_files.h"
#include "support/thread_reserve.h"
#include "support/write_together.h"

namespace bihive::cli {
namespace {

using workbench::Comparison;
using workbench::KindResult;
using workbench::StructureResult;

constexpr int kCostPicturePx = 192;  // of a report

// A set of these spheres alone: centres and radii, without attributes.
void keep_selected(Scene& scene, const std::vector<std::uint8_t>& mask) {
  const SphereSet& all = scene.spheres;
  StoredSpheres kept;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (mask[i] == 0) continue;
    kept.x.push_back(all.x()[i]);
    kept.y.push_back(all.y()[i]);
    kept.z.push_back(all.z()[i]);
    kept.r.push_back(all.r()[i]);
  }
  SphereSet set = SphereSet::from_stored(std::move(kept), all.scale_exponent(), all.origin());
  Scene without_spheres;
  without_spheres.name = scene.name;
  without_spheres.camera = scene.camera;
  without_spheres.lights = scene.lights;
  without_spheres.spheres = std::move(set);
  scene = std::move(without_spheres);
}

// A camera and a light for spheres without.
void complete(Input& input) {
  Scene& scene = input.scene;
  workbench::complete_for_queries(scene, input.has_camera, input.has_lights);
  if (!scene.clips.empty() || scene.sticks.total_size(scene.spheres) > 0)
    warn("structures are built from whole spheres: clips and sticks do not count");
}

// A structure that answers wrongly is a fault of this program.
[[noreturn]] void fail_of_bits(const char* structure, std::int64_t different, const std::string& queries) {
  fail({fmt::format("{} answers {} of {} with other bits than the reference BIH", structure, grouped(different),
                    queries),
        "", 0, 0, "please report it, with the input"});
}

void print_and_write(const CompareOptions& options, const std::string& html, const std::string& json,
                     const std::string& text) {
  if (!options.output.empty()) write_together({{output_path(options.output), html}});
  if (options.json)
    print(json + "\n");
  else
    print_report(text, outputs_of(options));
}

void compare(const CompareOptions& options, const Scene& scene) {
  workbench::ComparisonOptions wanted;
  wanted.structures = options.structures;
  wanted.kinds = options.kinds;
  wanted.count = options.count;
  wanted.threads = options.threads;
  if (!options.output.empty()) wanted.cost_picture_px = kCostPicturePx;
  Comparison comparison;
  {
    Progress progress("comparing");
    wanted.progress = [&progress](double done) { progress.update(done); };
    comparison = value_or_fail(workbench::compare_structures(scene, wanted));
  }
  print_and_write(options, options.output.empty() ? "" : comparison_html(comparison, scene.name),
                  options.json ? workbench::comparison_json(comparison, scene.name) : "",
                  comparison_text(comparison, scene.name));
  for (const StructureResult& one : comparison.structures)
    for (const KindResult& kind : one.kinds)
      if (kind.different > 0)
        fail_of_bits(one.row.name, kind.different,
                     fmt::format("{} queries ({})", grouped(kind.queries), workbench::row_of(kind.kind).name));
}

void sweep(const CompareOptions& options, const Scene& scene) {
  workbench::SweepOptions wanted;
  for (const std::string& text : options.sweep)
    if (const Status status = workbench::add_parameter_values(text, wanted.values); !status)
      fail_usage("--sweep: " + status.error().message, status.error().hint);
  wanted.structures = options.structures;
  wanted.kinds = options.kinds;
  wanted.count = options.count;
  wanted.threads = options.threads.front();
  workbench::Sweep swept;
  {
    Progress progress("sweeping");
    wanted.progress = [&progress](double done) { progress.update(done); };
    swept = value_or_fail(workbench::sweep_parameters(scene, wanted));
  }
  print_and_write(options, options.output.empty() ? "" : sweep_html(swept, scene.name),
                  options.json ? workbench::sweep_json(swept, scene.name) : "", sweep_text(swept, scene.name));
  for (const workbench::SweptStructure& one : swept.structures)
    for (const workbench::SweepPoint& point : one.points)
      if (point.different > 0)
        fail_of_bits(one.row.name, point.different, "its queries with " + text_of(point.parameters));
}

void trace_pixel(const CompareOptions& options, const Scene& scene) {
  const int side = workbench::side_of_primary_px(options.count);
  const auto [x, y] = *options.pixel;
  if (x >= side || y >= side)
    fail_usage(fmt::format("--pixel {},{} lies outside the picture of {} x {} pixels", x, y, side, side),
               "--rays-count N has a picture of about N pixels");
  const Ray ray = workbench::primary_ray(scene, side, x, y);
  const auto paths =
      value_or_fail(workbench::paths_of_ray(scene.spheres, options.structures, ray, options.threads.front()));
  if (options.json)
    print(workbench::ray_paths_json(paths, scene.name) + "\n");
  else
    print(ray_paths_text(paths, scene.name, *options.pixel, side));
}

void check_usage(const CompareOptions& options) {
  refuse_copies(options.input, "structures are built from the stored spheres");
  if (options.json && on_standard_output(outputs_of(options)))
    fail_usage("--json and a report on - would share the standard output");
  if (options.pixel && (!options.sweep.empty() || !options.output.empty()))
    fail_usage("--pixel prints the path of one ray", "leave out --sweep and -o");
  workbench::ParameterValues values;
  for (const std::string& text : options.sweep)
    if (const Status status = workbench::add_parameter_values(text, values); !status)
      fail_usage("--sweep: " + status.error().message, status.error().hint);
}

Scene spheres_to_compare(const InputOptions& options, const std::string& select,
                         const std::vector<std::string>& outputs) {
  Input input = load_input(options);
  check_outputs(outputs, input.files, /*are_text=*/true);
  if (!select.empty()) {
    const std::vector<std::uint8_t> mask = selected_or_fail(input.scene.spheres, select, "select");
    keep_selected(input.scene, mask);
    if (input.scene.spheres.empty()) fail({"no sphere is selected by " + select, "", 0, 0, "bihive select counts"});
  }
  complete(input);
  return std::move(input.scene);
}

}  // namespace

void run_compare(const CompareOptions& options) {
  if (options.boxes) return run_compare_boxes(options);
  check_usage(options);
  check_outputs(outputs_of(options), inputs_of(options), /*are_text=*/true);
  const Scene scene = spheres_to_compare(options.input, options.select, outputs_of(options));
  std::int64_t threads = 1;
  for (const int count : options.threads)
    threads = std::max<std::int64_t>(threads, count > 0 ? count : hardware_threads());
  renew_group_limit_for_threads(threads);
  if (options.pixel)
    trace_pixel(options, scene);
  else if (!options.sweep.empty())
    sweep(options, scene);
  else
    compare(options, scene);
}

void run_tune(const TuneCommandOptions& options) {
  refuse_copies(options.input, "trees are built from the stored spheres");
  const Scene scene = spheres_to_compare(options.input, options.select, {});
  renew_group_limit_for_threads(options.threads);
  workbench::TuneOptions wanted;
  wanted.structure = options.structure;
  wanted.kinds = options.kinds;
  wanted.count = options.count;
  wanted.threads = static_cast<int>(options.threads);
  workbench::Tuning tuning;
  {
    Progress progress("tuning");
    wanted.progress = [&progress](double done) { progress.update(done); };
    tuning = value_or_fail(workbench::tune_structure(scene, wanted));
  }
  print(options.json ? workbench::tuning_json(tuning, scene.name) + "\n" : tuning_text(tuning, scene.name));
}

}  // namespace bihive::cli
