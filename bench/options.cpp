#include "options.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "bihive/base/parse_number.h"
#include "bihive/base/setting_name.h"
#include "bihive/bih/tree.h"
#include "bihive/job/failure.h"
#include "bihive/job/picture_options.h"
#include "bihive/job/values.h"

namespace bihive::bench {
namespace {

constexpr double kLargestFloat = 3.4028234663852886e38;
constexpr const char* kExamples =
    "Examples:\n"
    "  bihive-bench scenario1 --peer embree --threads 2\n"
    "  bihive-bench molecule.pdb --peer embree --only build,primary,shadow --target avx2 --json";

// An option with one value of its own syntax: `parse` turns the text into a Result.
template <class Target, class Parse>
void add_value(CLI::App& app, const std::string& name, Target& target, const std::string& type, const std::string& help,
               Parse parse) {
  const auto take = [&target, name, parse](const std::string& text) {
    auto value = parse(text);
    if (!value) throw CLI::ValidationError(name, value.error().message);
    target = *value;
  };
  app.add_option_function<std::string>(name, take, help)->type_name(type);
}

template <class Target>
void add_integer(CLI::App& app, const std::string& name, Target& target, std::int64_t min, std::int64_t max,
                 const std::string& help) {
  add_value(app, name, target, "N", help,
            [min, max](const std::string& text) { return whole_number_from_text(text, min, max); });
}

template <class Target>
void add_number(CLI::App& app, const std::string& name, Target& target, const std::string& help) {
  add_value(app, name, target, "R", help,
            [](const std::string& text) { return number_from_text(text, 0, kLargestFloat); });
}

std::vector<std::string> words_of_only() {
  std::vector<std::string> words;
  for (const KindFacts& facts : kKinds) words.emplace_back(facts.name);
  words.emplace_back("build");
  words.emplace_back("frame");
  return words;
}

void add_input(CLI::App& app, BenchOptions& options) {
  InputOptions& input = options.input;
  app.add_option("INPUT", input.input,
                 "A file or a built-in name as in bihive, or a scene of the benchmark:\n"
                 "s1, s2, s3, mol, u1e5, mol5, c1e6, u1e6, u1e7 (uN: N = 1e3 to 1e8 uniform spheres)")
      ->type_name("")
      ->required();
  app.add_option("--molecule", options.molecule, "Scenes mol and mol5: the molecule (bundled: PDB entry 1HPV)")
      ->type_name("FILE");
  for (const RequestOption<InputOptions>& row : input_options()) {
    static constexpr std::string_view kOfBenchmark[] = {"count", "seed", "radius", "radius_scale", "recenter", "frame"};
    if (std::find(std::begin(kOfBenchmark), std::end(kOfBenchmark), row.id) == std::end(kOfBenchmark)) continue;
    const std::string name = option_of_setting(row.id);
    const auto take = [&row, &input, name](const std::string& text) {
      if (const Status status = row.take(input, text); !status)
        throw CLI::ValidationError(name, status.error().message);
    };
    if (row.value_name.empty())
      app.add_flag_callback(
          name, [take] { take(""); }, row.help);
    else
      app.add_option_function<std::string>(name, take, row.help)->type_name(row.value_name);
  }
}

}  // namespace

ParsedOptions parse_options(int argc, const char* const* argv) {
  CLI::App app("bihive-bench: times of ray queries and tree builds", "bihive-bench");
  app.footer(kExamples);
  app.get_formatter()->column_width(26);

  ParsedOptions parsed;
  BenchOptions& options = parsed.options;
  std::string peer;
  std::vector<std::string> only;
  add_input(app, options);
  app.add_option("--peer", peer, "Measure another ray tracer in turn: embree")
      ->type_name("NAME")
      ->check(CLI::IsMember({"embree"}));
  add_integer(app, "--threads", options.threads, 1, 4096, "Threads (1)");
  app.add_option("--only", only, "These alone, with commas: build, frame, and kinds of rays (all)")
      ->type_name("LIST")
      ->delimiter(',')
      ->check(CLI::IsMember(words_of_only()));
  add_integer(app, "--reps", options.reps, 1, 1000, "Repetitions, of which the median counts (7)");
  add_integer(app, "--rays", options.rays, 64, std::int64_t{1} << 26,
              "Primary and random rays, pixels of the frame, about (1048576)");
  add_value(app, "--ao-distance", options.ao_distance, "D", "Length of the rays of ambient occlusion (no limit)",
            [](const std::string& text) { return number_from_text(text, 0, kLargestFloat, true); });
  add_integer(app, "--tile", options.tile, 64, 1048576,
              "Rays that a thread takes at a time, at most (131072, random rays 1048576)");
  add_integer(app, "--call", options.call, 1, 1048576,
              "Rays per call, for programs that have few at a time (a tile's); 1: queries for one ray");
  app.add_option("--target", options.target,
                 "Instruction set of both: avx512, avx2, sse4 (the best); without a peer also scalar, neon")
      ->type_name("NAME");
  app.add_flag("--bound", options.bound,
               "Count the least work of all rays but primary ones, and the rate that two vector ports could reach");
  app.add_flag("--json", options.json, "Print one JSON object instead of text");

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success&) {
    parsed.text = app.help();
    return parsed;
  } catch (const CLI::ParseError& error) {
    fail_usage(error.what(), "see bihive-bench --help");
  }

  options.embree = peer == "embree";
  if (options.embree && (options.target == "scalar" || options.target == "neon"))
    fail_usage("--target " + options.target + ": Embree cannot be restricted to it",
               "leave out --peer, or choose avx512, avx2 or sse4");
  const auto asked = [&](std::string_view name) {
    return only.empty() || std::find(only.begin(), only.end(), name) != only.end();
  };
  for (const KindFacts& facts : kKinds)
    if (asked(facts.name)) options.kinds.push_back(facts.kind);
  options.build = asked("build");
  options.frame = asked("frame");
  return parsed;
}

}  // namespace bihive::bench
