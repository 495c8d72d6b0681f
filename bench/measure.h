// All timings: ours and the peer's in turn, medians.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench_scene.h"
#include "judge.h"
#include "least_work.h"
#include "options.h"

namespace bihive::bench {

/// Times of builds. `fresh` starts without memory of an earlier build, `again` has it.
struct BuildTimes {
  double fresh_ms = 0, again_ms = 0;
  double best_ms() const { return again_ms < fresh_ms ? again_ms : fresh_ms; }
};

struct BuildResult {
  BuildTimes ours, peer;
  double bytes_per_sphere = 0, peer_bytes_per_sphere = 0;
  std::int64_t peak_bytes = 0;  ///< growth of the process during the first build, at its peak
  std::int64_t levels = 0, nodes = 0;
};

struct KindResult {
  KindFacts facts;
  std::int64_t rays = 0;
  std::int64_t tile = 0;       ///< rays that a thread took at a time
  double ms = 0, peer_ms = 0;  ///< of all rays once
  std::string peer_mode;
  Verdict verdict;
  LeastWork least;  ///< if requested

  double mray_per_s() const { return static_cast<double>(rays) / ms / 1000; }
  double peer_mray_per_s() const { return static_cast<double>(rays) / peer_ms / 1000; }
};

/// A whole picture with the scene's own materials, light and plane, as radiance.
struct FrameResult {
  double ms = 0;  ///< 0: not requested
  std::int64_t width_px = 0, height_px = 0;
  std::int64_t rays = 0;  ///< of all kinds
};

struct Measured {
  std::int64_t spheres = 0;
  std::string description, target, peer_version;
  double cycles_per_s = 0;  ///< 0: the least work was not requested
  BuildResult build;
  std::vector<KindResult> kinds;
  FrameResult frame;
};

/// Fails with kBadInput if the tree cannot be built, with kEnvironment if the peer cannot start.
Measured measure(const BenchScene& bench, const BenchOptions& options);

}  // namespace bihive::bench
