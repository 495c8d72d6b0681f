// What the steps of Figure 4.4 measured, as its section reads it.
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

/// An engine with a tree, and the brute force that it is compared with: the same kernel without a tree, or where it has
/// none with one leaf.
struct ComparedEngine {
  std::string name;
  Engine tree, brute;
  TreeParameters brute_parameters;
  bool gpu = false;  ///< draws what these engines have built on the graphics processor
};
const std::vector<ComparedEngine>& compared_engines();

/// The step that measures one configuration, and the one that measures brute force on all scenarios in turn.
std::string configuration_step(const ComparedEngine& engine, std::int64_t scenario, std::int64_t spheres);
std::string independence_step(const ComparedEngine& engine);

/// Frames per second of one configuration, medians over the repetitions.
struct ConfigurationFps {
  double brute;
  std::vector<double> trees;  ///< in the order of max_prims_list

  /// Position of the fastest in `trees`.
  std::size_t best() const;
  /// Of the best tree over brute force, in percent.
  double gain_percent() const;
};

/// Keys of a step's result: why there is none, and the graphics processor's name.
constexpr const char* kMissing = "missing";
constexpr const char* kGpu = "gpu";

/// Why a step could not measure anything: nothing if it did. A machine without EGL has no graphics processor to
/// measure, and the experiment is complete without.
std::optional<std::string> why_missing(const Json& result);

/// Nothing if the step has not been done, or could not.
std::optional<ConfigurationFps> fps_of(const StepResults& results, const ComparedEngine& engine, std::int64_t scenario,
                                       std::int64_t spheres);

/// Of a list that is not empty; the upper one of two in the middle.
double median(std::vector<double> values);

Section figure_4_4_section(const SectionContext& context);

}  // namespace bihive::cli::thesis
