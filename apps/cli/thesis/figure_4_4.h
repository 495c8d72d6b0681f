// The measurements of Figure 4.4 in the form that its section reads.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bihive/render/tracer.h"
#include "thesis/experiment.h"

namespace bihive::cli::thesis {

/// An engine with a tree, and its brute force: the same code without a tree, or with one leaf if it cannot do without.
struct ComparedEngine {
  std::string name;
  Engine tree, brute;
  TreeParameters brute_parameters;
  bool gpu = false;  ///< draws what these engines have built on the graphics processor
};
const std::vector<ComparedEngine>& compared_engines();

/// The step that measures one configuration, and the step that measures brute force on all scenarios in turn.
std::string configuration_step(const ComparedEngine& engine, std::int64_t scenario, std::int64_t spheres);
std::string independence_step(const ComparedEngine& engine);

/// Frames per second of one configuration, medians over the repetitions.
struct ConfigurationFps {
  double brute;
  std::vector<double> trees;  ///< in the order of max_prims_list

  /// Position of the fastest in `trees`.
  std::size_t best() const;
  /// The gain of the best tree over brute force, in percent.
  double gain_percent() const;
};

/// Keys of a step's result: the reason why there is no measurement, and the graphics processor's name.
constexpr const char* kMissing = "missing";
constexpr const char* kGpu = "gpu";

/// The reason why a step could not measure; nothing if it could. A machine without EGL has no graphics processor to
/// measure, and the experiment is complete without it.
std::optional<std::string> why_missing(const Json& result);

/// Nothing if the step is not done, or could not measure.
std::optional<ConfigurationFps> fps_of(const StepResults& results, const ComparedEngine& engine, std::int64_t scenario,
                                       std::int64_t spheres);

/// The median of a list that is not empty; of two middle values the larger one.
double median(std::vector<double> values);

Section figure_4_4_section(const SectionContext& context);

}  // namespace bihive::cli::thesis
