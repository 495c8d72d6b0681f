// The command line of bihive-bench.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bihive/job/input.h"
#include "kinds.h"

namespace bihive::bench {

struct BenchOptions {
  InputOptions input;    ///< input.input may also be a bench scene's name (bench_scene.h)
  std::string molecule;  ///< file of the scenes mol and mol5; empty: the bundled molecule
  bool embree = false;   ///< measure Embree beside us
  std::int64_t threads = 1;
  std::vector<Kind> kinds;  ///< in the order of kKinds
  bool build = true, frame = true;
  std::int64_t reps = 7;
  std::int64_t rays = 1024 * 1024;    ///< primary and random rays, pixels of the frame; the others follow
  std::optional<double> ao_distance;  ///< world units; unset: no limit
  std::int64_t tile = 0;              ///< rays that a thread takes at a time, at most; 0: the kind's own number
  std::int64_t call = 0;              ///< rays of one call; 0: a tile's; 1: the queries for one ray, and the peer's
  bool bound = false;                 ///< count the least work of incoherent rays
  std::string target;                 ///< empty: the best
  bool json = false;
};

/// Fails with kBadUsage on unknown or wrong options. A text to be printed instead (help) is returned as a string.
struct ParsedOptions {
  BenchOptions options;
  std::optional<std::string> text;
};
ParsedOptions parse_options(int argc, const char* const* argv);

}  // namespace bihive::bench
