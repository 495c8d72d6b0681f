// `bihive trace` against the long-double oracle, on every ray of every hostile scene.
//
//   trace_oracle --bihive PROGRAM [--rays N] [--threads N] [--scene NAME] [--seed N]     (or BIHIVE in the environment)
//   trace_oracle --library ...                                                          the library, without files
//
// An answer is right if it is the oracle's. It is also right if binary64 can give it where binary64 and the oracle
// differ. tests/support/oracle.h states that as an interval for each root. Such an interval is at most a few 1e-15 of
// the distance wide, far within the relative 1e-12 that the project allows itself. These answers count as excused, and
// too many of them fail too. Spheres that are equal bit for bit have equal roots in both arithmetics, so the smaller id
// is always required. The test judges the reference engine. The engine `auto` must give its bits on every ray. On the
// first million rays `auto` on every other instruction set of this machine and brute force must give its bits too, and
// --any must agree.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bihive/base/parallel.h"
#include "bihive/base/timer.h"
#include "support/edge_rays.h"
#include "support/engine_under_test.h"
#include "support/oracle.h"
#include "support/ray_maker.h"
#include "support/scenes.h"

namespace bihive::test {
namespace {

constexpr std::int64_t kChunk = 500000;          // rays in memory at a time
constexpr std::int64_t kComparedRays = 1000000;  // rays for brute force and any-hit
// Shares of all rays that may be excused: for rays that aim at ties and ends on purpose, and for the other rays.
constexpr double kMostOnPurpose = 1e-2;
constexpr double kMostAtSilhouettes = 1e-4;
constexpr double kFewAnyway = 5;  // rays, so that a short run does not fail by chance
constexpr double kFewestHits = 0.2;

struct Options {
  std::string program, scene;
  bool library = false;
  std::int64_t rays = 200000;
  int threads = 0;
  std::uint64_t seed = 1;
};

// Why binary64 and long double may differ: a root at an end of the segment, two spheres met at one t, a silhouette.
enum Reason { kEnd, kTie, kSilhouette };

struct Tally {
  std::int64_t rays = 0, hits = 0, wrong = 0, excused[3] = {0, 0, 0};
  double worst_error = 0;  // of t away from silhouettes, in u (L + r) / D

  void add(const Tally& other) {
    rays += other.rays;
    hits += other.hits;
    for (int reason = 0; reason < 3; ++reason) excused[reason] += other.excused[reason];
    wrong += other.wrong;
    worst_error = std::max(worst_error, other.worst_error);
  }
};

Reason reason_to_differ(const Ray& ray, const std::vector<Encounter>& encounters, double t, std::int64_t id,
                        const Oracle::Answer& truth) {
  for (const Encounter& e : encounters) {
    if (e.id != id && e.id != truth.id) continue;
    for (const double end : {ray.t_min, ray.t_max})
      if ((end >= e.near_lo && end <= e.near_hi) || (end >= e.far_lo && end <= e.far_hi)) return kEnd;
    if (id >= 0 && truth.id >= 0 && std::abs(t - truth.t) <= 32 * e.t_error_unit) return kTie;
  }
  return kSilhouette;
}

void judge(const Oracle& oracle, const Ray& ray, double t, std::int64_t id, const std::int64_t* any, Tally& tally) {
  const std::vector<Encounter> encounters = oracle.encounters(ray);
  const Oracle::Answer truth = Oracle::closest(ray, encounters);
  ++tally.rays;
  tally.hits += truth.id >= 0 ? 1 : 0;
  const bool right =
      oracle.accepts(ray, encounters, t, id) && (any == nullptr || Oracle::accepts_any(ray, encounters, *any == 0));
  if (!right) {
    if (tally.wrong++ == 0)
      std::fprintf(stderr, "WRONG: t %a of %lld, oracle %.17Lg of %lld, any %lld: %s\n", t, static_cast<long long>(id),
                   truth.t, static_cast<long long>(truth.id), any ? static_cast<long long>(*any) : -9,
                   text_of(ray).c_str());
    return;
  }
  if (id != truth.id) ++tally.excused[reason_to_differ(ray, encounters, t, id, truth)];
  if (id < 0 || id != truth.id) return;
  for (const Encounter& e : encounters) {
    if (e.id != id) continue;
    const double error = static_cast<double>(std::abs(t - truth.t) / e.t_error_unit);
    const bool other_root = std::abs(t - truth.t) > 0.5L * (e.t_far - e.t_near);
    if (other_root) ++tally.excused[kEnd];
    if (!other_root && e.discriminant_share > 0.01L) tally.worst_error = std::max(tally.worst_error, error);
  }
}

/// Prints the first difference between two engines; returns false if there is one, or if an engine failed.
bool same_answers(const std::vector<Ray>& rays, const std::optional<Answers>& a, const std::optional<Answers>& b,
                  const std::string& names) {
  if (!a || !b) return false;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (a->id[i] == b->id[i] && std::memcmp(&a->t[i], &b->t[i], sizeof(double)) == 0) continue;
    std::fprintf(stderr, "ENGINES DIFFER: %s: %a of %lld, %a of %lld: %s\n", names.c_str(), a->t[i],
                 static_cast<long long>(a->id[i]), b->t[i], static_cast<long long>(b->id[i]), text_of(rays[i]).c_str());
    return false;
  }
  return true;
}

/// The right answer of --any, from the closest hits.
Answers any_of(const Answers& closest) {
  Answers any = closest;
  for (std::size_t i = 0; i < any.id.size(); ++i)
    if (any.id[i] >= 0) any.t[i] = 0, any.id[i] = 0;
  return any;
}

/// One chunk of rays; false if the engine failed or two engines differ.
bool run_chunk(EngineUnderTest& engine, const Oracle& oracle, const std::vector<Ray>& rays, bool compare, int threads,
               Tally& tally) {
  if (!engine.set_rays(rays)) return false;
  const auto reference = engine.trace("reference", false);
  if (!reference) return false;
  if (!same_answers(rays, reference, engine.trace("auto", false), "reference, auto")) return false;
  std::optional<Answers> any;
  if (compare) {
    any = engine.trace("reference", true);
    const Answers expected = any_of(*reference);
    if (!same_answers(rays, expected, any, "closest hits, --any") ||
        !same_answers(rays, expected, engine.trace("auto", true), "closest hits, auto --any") ||
        !same_answers(rays, reference, engine.trace("brute", false), "reference, brute") ||
        !same_answers(rays, expected, engine.trace("brute", true), "closest hits, brute --any"))
      return false;
    for (const std::string& target : available_targets())
      if (target != available_targets().front() &&
          !same_answers(rays, reference, engine.trace("auto", false, target), "reference, auto on " + target))
        return false;
  }
  constexpr std::size_t kBlock = 512;
  const std::size_t blocks = (rays.size() + kBlock - 1) / kBlock;
  std::vector<Tally> tallies(blocks);
  parallel_for(threads, static_cast<std::int64_t>(blocks), [&](std::int64_t block) {
    const std::size_t first = static_cast<std::size_t>(block) * kBlock;
    for (std::size_t i = first; i < std::min(first + kBlock, rays.size()); ++i)
      judge(oracle, rays[i], reference->t[i], reference->id[i], any ? &any->id[i] : nullptr,
            tallies[static_cast<std::size_t>(block)]);
  });
  for (const Tally& part : tallies) tally.add(part);
  return true;
}

bool run_scene(EngineUnderTest& engine, const World& world, const Options& options) {
  const Timer timer;
  const Oracle oracle(world);
  const RayMaker make_ray(world, options.seed);
  Tally tally;
  bool ran = engine.load(world);
  for (std::int64_t first = 0; ran && first < options.rays; first += kChunk) {
    std::vector<Ray> rays(static_cast<std::size_t>(std::min(kChunk, options.rays - first)));
    parallel_for(options.threads, static_cast<std::int64_t>(rays.size()), [&](std::int64_t i) {
      rays[static_cast<std::size_t>(i)] = make_ray(static_cast<std::uint64_t>(first + i));
    });
    ran = run_chunk(engine, oracle, rays, first < kComparedRays, options.threads, tally);
  }
  const double rays = static_cast<double>(std::max<std::int64_t>(1, tally.rays));
  const bool enough_hits = static_cast<double>(tally.hits) >= kFewestHits * rays;
  const bool few_excused =
      static_cast<double>(tally.excused[kEnd] + tally.excused[kTie]) <= kFewAnyway + kMostOnPurpose * rays &&
      static_cast<double>(tally.excused[kSilhouette]) <= kFewAnyway + kMostAtSilhouettes * rays;
  const bool good = ran && tally.rays == options.rays && tally.wrong == 0 && enough_hits && few_excused;
  std::printf("%-14s %7zu %10lld %7.2f %6lld %6lld %6lld %6lld %7.2f %8.1f  %s\n", world.name.c_str(), world.size(),
              static_cast<long long>(tally.rays), 100 * static_cast<double>(tally.hits) / rays,
              static_cast<long long>(tally.excused[kEnd]), static_cast<long long>(tally.excused[kTie]),
              static_cast<long long>(tally.excused[kSilhouette]), static_cast<long long>(tally.wrong),
              tally.worst_error, timer.elapsed_ms() / 1000,
              good           ? "good"
              : !ran         ? "FAILED to run"
              : tally.wrong  ? "WRONG"
              : !enough_hits ? "TOO FEW HITS"
                             : "TOO MANY EXCUSED");
  std::fflush(stdout);
  return good;
}

int run(const Options& options) {
  std::unique_ptr<EngineUnderTest> engine;
  if (options.library) {
    engine = std::make_unique<LibraryUnderTest>(options.threads);
  } else {
    std::string folder = (std::filesystem::temp_directory_path() / "trace_oracle_XXXXXX").string();
    if (mkdtemp(folder.data()) == nullptr) {
      std::fprintf(stderr, "cannot make a folder for the files: %s\n", folder.c_str());
      return 1;
    }
    engine = std::make_unique<ProgramUnderTest>(options.program, folder);
  }
  std::printf(
      "seed %llu. Excused at an end of the segment, a tie, a silhouette. Error: the largest |t - oracle| in\n"
      "2^-53 (distance + radius) / |direction|, away from silhouettes.\n",
      static_cast<unsigned long long>(options.seed));
  std::printf("%-14s %7s %10s %7s %6s %6s %6s %6s %7s %8s\n", "scene", "spheres", "rays", "hits %", "end", "tie",
              "silh.", "wrong", "error", "seconds");
  bool all_good = true, any_scene = false;
  for (const World& world : hostile_worlds(4096, 1000)) {
    if (!options.scene.empty() && options.scene != world.name) continue;
    any_scene = true;
    all_good = run_scene(*engine, world, options) && all_good;
  }
  if (!any_scene) std::fprintf(stderr, "no scene is called %s\n", options.scene.c_str());
  return all_good && any_scene ? 0 : 1;
}

}  // namespace
}  // namespace bihive::test

int main(int argc, char** argv) {
  bihive::test::Options options;
  if (const char* program = std::getenv("BIHIVE")) options.program = program;
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    const char* const value = i + 1 < argc ? argv[i + 1] : "";
    if (name == "--library") {
      options.library = true;
      continue;
    }
    ++i;
    if (name == "--bihive")
      options.program = value;
    else if (name == "--rays")
      options.rays = std::atoll(value);
    else if (name == "--threads")
      options.threads = std::atoi(value);
    else if (name == "--scene")
      options.scene = value;
    else if (name == "--seed")
      options.seed = std::strtoull(value, nullptr, 10);
    else {
      std::fprintf(stderr, "unknown option %s; see the top of trace_oracle.cpp\n", name.c_str());
      return 2;
    }
  }
  if (!options.library && options.program.empty()) {
    std::fprintf(stderr, "name the program by --bihive or BIHIVE, or say --library\n");
    return 2;
  }
  return bihive::test::run(options);
}
