#include "measure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "bihive/base/parallel.h"
#include "bihive/base/resident_memory.h"
#include "bihive/base/timer.h"
#include "bihive/job/failure.h"
#include "bihive/math/quartiles.h"
#include "bihive/simd/target.h"
#include "bihive/wide/wide_builder.h"
#include "frames/frame.h"
#include "peers/embree.h"
#include "tiles.h"

namespace bihive::bench {
namespace {

// A timing shorter than this repeats its work.
constexpr double kShortestTimingMs = 20;
// Builds are repeated until they have taken this long, but at least kFewestBuilds times.
constexpr double kBuildBudgetMs = 6000;
constexpr std::int64_t kFewestBuilds = 3;
// A timing longer than this takes only some tiles of the rays: at least kFewestTiles, the same for ours and the peer.
constexpr double kLongestTimingMs = 200;
constexpr std::int64_t kFewestTiles = 8;
constexpr double kLongestPeerMs = 2000;
// The modes of the peer that come this close to the fastest on a sample are measured in full. A mode that is slower
// than kHopeless times the current best at its first try gets no second try.
constexpr double kCloseToBest = 1.1;
constexpr double kHopeless = 1.5;
constexpr int kTries = 3;
constexpr std::size_t kMostModes = 2;

// Builds

struct Built {
  std::shared_ptr<const WideTree> tree;
  BuildResult result;
};

std::shared_ptr<const WideTree> build(WideBuilder& builder, const SphereSet& spheres, int threads) {
  auto tree = builder.build(spheres, {}, threads);
  if (!tree) fail(tree.error());
  return std::move(*tree);
}

Built measure_builds(const BenchScene& bench, const BenchOptions& options, Embree* peer) {
  const SphereSet& spheres = bench.scene.spheres;
  const auto threads = static_cast<int>(options.threads);

  // The first build of the process shows its memory.
  Built built;
  forget_peak();
  const std::int64_t before = resident_bytes();
  WideBuilder builder;
  built.tree = build(builder, spheres, threads);
  built.result.peak_bytes = std::max<std::int64_t>(0, peak_bytes() - before);
  built.result.levels = built.tree->levels;
  built.result.nodes = built.tree->node_count;
  const auto n = static_cast<double>(spheres.size());
  built.result.bytes_per_sphere = static_cast<double>(built.tree->used_bytes()) / n;
  if (peer != nullptr) peer->build_fresh_ms();

  // Take turns: a build from nothing, and a build in kept memory.
  std::vector<double> fresh, again, peer_fresh, peer_again;
  const Timer total;
  for (std::int64_t rep = 0; options.build && rep < std::max(options.reps, kFewestBuilds); ++rep) {
    if (rep >= kFewestBuilds && total.elapsed_ms() > kBuildBudgetMs) break;
    {
      const Timer timer;
      WideBuilder once;
      const auto tree = build(once, spheres, threads);
      fresh.push_back(timer.elapsed_ms());
    }
    if (peer != nullptr) peer_fresh.push_back(peer->build_fresh_ms());
    {
      built.tree.reset();
      const Timer timer;
      built.tree = build(builder, spheres, threads);
      again.push_back(timer.elapsed_ms());
    }
    if (peer != nullptr) peer_again.push_back(peer->rebuild_ms());
  }
  if (options.build) built.result.ours = {median(fresh), median(again)};
  if (peer != nullptr) {
    if (options.build) built.result.peer = {median(peer_fresh), median(peer_again)};
    built.result.peer_bytes_per_sphere = static_cast<double>(peer->bytes()) / n;
  }
  return built;
}

// Rays

// The rays of a range, one query after the other.
void trace_one_by_one(const WideTree& tree, const RaySet& set, const Tiles::Range& range, Answers& answers) {
  const RaySpan rays = set.rays.span();
  for (std::int64_t i = range.begin; i < range.end; ++i) {
    if (set.facts.any_hit) {
      answers.hidden[static_cast<std::size_t>(i)] = occluded(tree, rays.at(i)) ? 1 : 0;
      continue;
    }
    const Hit hit = closest_hit(tree, rays.at(i));
    answers.hits.t[static_cast<std::size_t>(i)] = hit.t;
    answers.hits.sphere_id[static_cast<std::size_t>(i)] = hit.sphere_id;
  }
}

// Traces the tiles once, spread over the threads, `call` rays at a time (0: a tile).
double trace_ours_ms(const WideTree& tree, const RaySet& set, int threads, const Tiles& tiles, std::int64_t call,
                     Answers& answers) {
  const RaySpan rays = set.rays.span();
  const Timer timer;
  parallel_for(threads, tiles.count(), [&](std::int64_t i) {
    const Tiles::Range tile = tiles.range(i);
    if (call == 1) return trace_one_by_one(tree, set, tile, answers);
    const std::int64_t step = call > 0 ? call : tile.end - tile.begin;
    for (std::int64_t first = tile.begin; first < tile.end; first += step) {
      const RaySpan part = rays.part(first, std::min(step, tile.end - first));
      if (set.facts.any_hit)
        occluded(tree, part, set.facts.order, answers.hidden.data() + first);
      else
        closest_hits(tree, part, set.facts.order, answers.hits.span().part(first));
    }
  });
  return timer.elapsed_ms();
}

// One mode of the peer that is measured in full.
struct Contender {
  EmbreeMode mode;
  std::shared_ptr<EmbreeRays> rays;
  std::vector<double> ms;
};

// Tries every mode on a sample of the rays; returns the best one, and those that come close to it.
// A program with `call` rays at a time (0: as many as it likes) has no larger packets.
std::vector<Contender> best_modes(const Embree& peer, const RaySet& set, const Tiles& sample, std::int64_t call) {
  struct Tried {
    double ms;
    EmbreeMode mode;
    std::shared_ptr<EmbreeRays> rays;
  };
  std::vector<Tried> tried;
  double best = std::numeric_limits<double>::infinity();
  for (const int width : {16, 8, 4, 1}) {
    if (call > 0 && width > call) continue;
    const std::shared_ptr<EmbreeRays> rays = peer.prepare(set, width);
    for (const bool coherent : {false, true}) {
      double ms = peer.trace_ms(*rays, coherent, sample);
      for (int i = 1; i < kTries && ms < best * kHopeless; ++i)
        ms = std::min(ms, peer.trace_ms(*rays, coherent, sample));
      best = std::min(best, ms);
      tried.push_back({ms, {width, coherent}, rays});
    }
  }
  std::sort(tried.begin(), tried.end(), [](const Tried& a, const Tried& b) { return a.ms < b.ms; });
  std::vector<Contender> contenders;
  for (const Tried& one : tried) {
    if (one.ms > best * kCloseToBest || contenders.size() == kMostModes) break;
    contenders.push_back({one.mode, one.rays, {}});
  }
  return contenders;
}

// Blocks of 64 rays, spread over the set, that the peer traces in about kLongestTimingMs if all would take it longer
// than kLongestPeerMs, as sets of many equal spheres do.
std::optional<Tiles> sample_of_slow_peer(const Embree& peer, const RaySet& set) {
  constexpr std::int64_t kBlock = 64, kProbes = 4;
  const std::int64_t rays = set.rays.size(), blocks = (rays + kBlock - 1) / kBlock;
  if (blocks < kProbes) return std::nullopt;
  const Tiles probe(rays, kBlock, blocks / kProbes);
  const double ms_per_block = peer.trace_ms(*peer.prepare(set, 1), false, probe) / static_cast<double>(probe.count());
  if (ms_per_block * static_cast<double>(blocks) < kLongestPeerMs) return std::nullopt;
  const auto affordable = std::max(kProbes, static_cast<std::int64_t>(kLongestTimingMs / ms_per_block));
  return Tiles(rays, kBlock, std::max<std::int64_t>(1, blocks / affordable));
}

// The size of tiles of at most `most` rays, such that the threads share the tiles evenly.
std::int64_t even_tile(std::int64_t rays, std::int64_t most, std::int64_t threads) {
  const std::int64_t rounds = (rays + most * threads - 1) / (most * threads);
  const std::int64_t tiles = rounds * threads;
  return (rays + 64 * tiles - 1) / (64 * tiles) * 64;
}

// How often to repeat work that takes this long once.
std::int64_t passes_for(double ms) {
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(kShortestTimingMs / std::max(ms, 1e-3))));
}

template <class Work>
double mean_ms(std::int64_t passes, Work work) {
  double sum = 0;
  for (std::int64_t i = 0; i < passes; ++i) sum += work();
  return sum / static_cast<double>(passes);
}

KindResult measure_kind(const BenchScene& bench, const WideTree& tree, const RaySet& set, const BenchOptions& options,
                        const Embree* peer) {
  KindResult result;
  result.facts = set.facts;
  result.rays = set.rays.size();
  if (result.rays == 0) return result;

  // A first pass of each warms up, and tells how often a timing must repeat it.
  Answers answers;
  if (set.facts.any_hit) {
    answers.hidden.resize(static_cast<std::size_t>(result.rays));
  } else {
    answers.hits.resize(result.rays);
  }
  const auto threads = static_cast<int>(options.threads);
  const std::int64_t tile = even_tile(result.rays, options.tile > 0 ? options.tile : set.facts.tile, options.threads);
  result.tile = tile;
  const Tiles all = Tiles::all(result.rays, tile);
  double longest = trace_ours_ms(tree, set, threads, all, options.call, answers);
  std::vector<Contender> contenders;
  std::optional<Tiles> few;  // all that a slow peer traces
  if (peer != nullptr) {
    few = sample_of_slow_peer(*peer, set);
    const Tiles tried = few ? *few : Tiles(result.rays, tile, std::max<std::int64_t>(1, all.count() / kFewestTiles));
    contenders = best_modes(*peer, set, tried, options.call);
  }
  if (peer != nullptr && !few) {
    for (const Contender& contender : contenders)
      longest = std::max(longest, peer->trace_ms(*contender.rays, contender.mode.coherent, all));
  }
  std::int64_t step = 1;
  while (longest / static_cast<double>(step) > kLongestTimingMs && all.count() / (2 * step) >= kFewestTiles) step *= 2;
  const Tiles timed(result.rays, tile, step);
  const double share = static_cast<double>(timed.rays()) / static_cast<double>(result.rays);
  const auto ours = [&] { return trace_ours_ms(tree, set, threads, timed, options.call, answers) / share; };
  const std::int64_t passes = passes_for(ours() * share);
  std::int64_t peer_passes = 1;
  const auto theirs = [&](const Contender& contender) {
    if (!few) return peer->trace_ms(*contender.rays, contender.mode.coherent, timed) / share;
    return peer->trace_ms(*contender.rays, contender.mode.coherent, *few) * static_cast<double>(result.rays) /
           static_cast<double>(few->rays());
  };
  if (peer != nullptr) peer_passes = few ? 1 : passes_for(theirs(contenders[0]) * share);

  // In turn.
  std::vector<double> times;
  for (std::int64_t rep = 0; rep < options.reps; ++rep) {
    times.push_back(mean_ms(passes, ours));
    for (Contender& contender : contenders)
      contender.ms.push_back(mean_ms(peer_passes, [&] { return theirs(contender); }));
  }
  result.ms = median(times);
  if (contenders.empty()) {
    result.verdict = judge_alone(bench.scene.spheres, set, answers);
    return result;
  }

  // The peer's best mode counts; its answers are compared.
  const auto best = std::min_element(contenders.begin(), contenders.end(),
                                     [](const auto& a, const auto& b) { return median(a.ms) < median(b.ms); });
  result.peer_ms = median(best->ms);
  result.peer_mode = best->mode.name();
  if (few) {
    result.verdict = judge_alone(bench.scene.spheres, set, answers);
    return result;
  }
  result.verdict = judge(bench.scene.spheres, tree, set, answers, best->rays->answers(),
                         [&](const Ray& ray) { return peer->closest(ray); });
  return result;
}

FrameResult measure_frame(const BenchScene& bench, const BenchOptions& options) {
  const RenderSettings settings = whole_picture(static_cast<int>(options.threads), picture_side_px(options.rays));
  const Tracer tracer =
      value_or_fail(Tracer::build(bench.scene.spheres, Engine::wide, {}, static_cast<int>(options.threads)));
  FrameTimes warm, times;
  add_frame(bench.scene, tracer, settings, warm);
  for (std::int64_t rep = 0; rep < options.reps; ++rep) add_frame(bench.scene, tracer, settings, times);
  const RenderCounts& rays = times.rays;
  return {times.render_ms(), settings.width_px, settings.height_px,
          rays.primary + rays.shadow + rays.reflected + rays.transmitted + rays.ambient};
}

}  // namespace

Measured measure(const BenchScene& bench, const BenchOptions& options) {
  Measured measured;
  measured.spheres = bench.scene.spheres.size();
  measured.description = bench.description;
  measured.target = active_target();
  std::unique_ptr<Embree> peer;
  if (options.embree) {
    auto started = Embree::start(bench.scene.spheres, static_cast<int>(options.threads), measured.target);
    if (!started) throw Failure{kEnvironment, started.error()};
    peer = std::move(*started);
    measured.peer_version = Embree::version();
  }
  const Built built = measure_builds(bench, options, peer.get());
  measured.build = built.result;
  if (options.frame) measured.frame = measure_frame(bench, options);
  if (options.kinds.empty()) return measured;
  for (const RaySet& set : make_ray_sets(bench, *built.tree, options)) {
    measured.kinds.push_back(measure_kind(bench, *built.tree, set, options, peer.get()));
    if (options.bound && has_bound(set.facts.kind)) measured.kinds.back().least = least_work(*built.tree, set);
  }
  if (options.bound) measured.cycles_per_s = clock_rate();
  return measured;
}

}  // namespace bihive::bench
