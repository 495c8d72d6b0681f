// The text's statements about Figure 4.4, judged on measured frames. Every verdict uses the quartiles over the rounds:
// a row whose quartiles reach across its limit is undecided.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "thesis/compare.h"

namespace bihive::cli::thesis {

/// Milliseconds of a frame, an entry a round. Contestants took turns, so entry i of all of them belongs together.
struct ConfigurationTimes {
  std::vector<double> brute;
  std::map<std::int64_t, std::vector<double>> trees;  ///< by MAX_PRIMS
};

/// All configurations of an engine that were measured, by scenario and number of spheres.
using EngineTimes = std::map<std::pair<std::int64_t, std::int64_t>, ConfigurationTimes>;

/// As a display shows them that shows at most so many frames a second.
EngineTimes capped(EngineTimes times, double fps);

/// Frames a second of the rounds.
Quartiles fps_quartiles(const std::vector<double>& frame_ms);

/// The quartiles of the rounds' ratios: above 1 where `one` is faster than `other`.
Quartiles times_as_fast(const std::vector<double>& one, const std::vector<double>& other);

/// The MAX_PRIMS of the fastest tree, by its median; 0 without trees. `takes_part`: by MAX_PRIMS; null: all do.
std::int64_t fastest_tree(const ConfigurationTimes& times,
                          const std::function<bool(std::int64_t)>& takes_part = nullptr);

/// A row. Rows of one table stand together.
struct Judgement {
  std::string table, name, statement;
  Expected expected;
  std::string ours;
  Verdict verdict;
};
std::vector<Judgement> judge_frame_rates(const EngineTimes& times, const Values& values);

/// The titles of the tables in their order, each with the rule of its verdicts.
std::vector<std::pair<std::string, std::string>> judgement_tables();

}  // namespace bihive::cli::thesis
