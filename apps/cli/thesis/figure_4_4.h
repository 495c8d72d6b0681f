// The measurements of Figure 4.4 in the form that its section reads. bihive/thesis/frame_rates.h makes them.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bihive/render/tracer.h"
#include "bihive/thesis/frame_rates.h"
#include "thesis/experiment.h"
#include "thesis/figure_4_4_cost_model.h"
#include "thesis/frame_verdicts.h"

namespace bihive::cli::thesis {

/// A FrameEngine with the name that its tables bear. `gpu`: the graphics processor draws.
struct ComparedEngine {
  std::string name;
  FrameEngine engine;
  bool gpu = false;
};
const std::vector<ComparedEngine>& compared_engines();

/// It traces by the text's algorithm and tree, as far as we could reconstruct them; what the text found of its own can
/// be asked of no other engine.
bool is_of_text(const ComparedEngine& engine);

/// What all trees of a configuration are measured with: the thesis's MAX_PRIMS, and for the engines of the processor
/// also larger ones, up to the number of spheres, which is a tree of one leaf.
std::vector<std::int64_t> measured_max_prims(const Values& values, const ComparedEngine& engine, std::int64_t spheres);

/// The step that measures one configuration, and the step that measures brute force on all scenarios in turn.
std::string configuration_step(const ComparedEngine& engine, std::int64_t scenario, std::int64_t spheres);
std::string independence_step(const ComparedEngine& engine);

/// Keys of a step's result: the reason why there is no measurement, and the graphics processor's name.
constexpr const char* kMissing = "missing";
constexpr const char* kGpu = "gpu";

/// The reason why a step could not measure; nothing if it could. A machine without EGL has no graphics processor to
/// measure, and the experiment is complete without it.
std::optional<std::string> why_missing(const Json& result);

/// The frames of the steps of these names that are done and could measure.
EngineTimes times_of_steps(const SectionContext& context,
                           const std::function<std::string(std::int64_t scenario, std::int64_t spheres)>& step);

/// The frames of an engine's steps that are done and could measure.
EngineTimes engine_times(const SectionContext& context, const ComparedEngine& engine);

/// The work of the rays, as the steps counts_step() counted it; without the scenarios whose step is not done.
FigureWork counted_work(const SectionContext& context);  // figure_4_4_counts.cpp
/// {MAX_PRIMS: {"nodes", "leaves", "tests"}}, as those steps save it; "nodes" are the inner ones.
WorkByTree work_from(const Json& trees);
/// The step that counts with many seeds, which Scenario 1 does not depend on.
std::string seeds_step(std::int64_t scenario);

/// The steps that count what rays do, without a clock, and how balanced the trees are.
std::string counts_step(std::int64_t scenario);
constexpr const char* kBalanceStep = "balance";
/// The step that measures the thesis program (bihive/thesis/thesis_program.h) in one configuration, and its frames.
std::string program_step(std::int64_t scenario, std::int64_t spheres);
Json measure_program(const StepContext& context, std::int64_t scenario, std::int64_t spheres);
/// The step that draws frames with bytes, as fast as this program can.
constexpr const char* kFloorStep = "frames_in_memory";
Json measure_frames_in_memory(const StepContext& context);  // figure_4_4_floor.cpp

/// The parts of the section, in the report's order.
void add_winner(const SectionContext& context, Section& section);     // figure_4_4_winner.cpp
void add_counts(const SectionContext& context, Section& section);     // figure_4_4_counts.cpp
void add_engines(const SectionContext& context, Section& section);    // figure_4_4_engines.cpp
void add_floor(const SectionContext& context, Section& section);      // figure_4_4_floor.cpp
void add_lost_bars(const SectionContext& context, Section& section);  // figure_4_4_lost_bars.cpp

Section figure_4_4_section(const SectionContext& context);

}  // namespace bihive::cli::thesis
