// The measurements of Figure 4.4 in the form that its section reads. bihive/thesis/frame_rates.h makes them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bihive/render/tracer.h"
#include "bihive/thesis/frame_rates.h"
#include "thesis/experiment.h"

namespace bihive::cli::thesis {

/// A FrameEngine with the name that its tables bear. `gpu`: the graphics processor draws.
struct ComparedEngine {
  std::string name;
  FrameEngine engine;
  bool gpu = false;
};
const std::vector<ComparedEngine>& compared_engines();

/// The step that measures one configuration, and the step that measures brute force on all scenarios in turn.
std::string configuration_step(const ComparedEngine& engine, std::int64_t scenario, std::int64_t spheres);
std::string independence_step(const ComparedEngine& engine);

/// Keys of a step's result: the reason why there is no measurement, and the graphics processor's name.
constexpr const char* kMissing = "missing";
constexpr const char* kGpu = "gpu";

/// The reason why a step could not measure; nothing if it could. A machine without EGL has no graphics processor to
/// measure, and the experiment is complete without it.
std::optional<std::string> why_missing(const Json& result);

/// Nothing if the step is not done, or could not measure.
std::optional<ConfigurationFps> fps_of(const StepResults& results, const ComparedEngine& engine, std::int64_t scenario,
                                       std::int64_t spheres);

Section figure_4_4_section(const SectionContext& context);

}  // namespace bihive::cli::thesis
