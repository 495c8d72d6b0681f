#include "report.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "bihive/base/readable.h"
#include "bihive/base/version.h"

namespace bihive::bench {
namespace {

using nlohmann::ordered_json;

// The processor's name from the system.
std::string machine() {
  std::ifstream cpuinfo("/proc/cpuinfo");
  std::string line;
  while (std::getline(cpuinfo, line)) {
    const std::size_t colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

ordered_json positive(double value) {
  return value > 0 ? ordered_json(value) : ordered_json();
}

ordered_json quotient(double value, double by) {
  return value > 0 && by > 0 ? ordered_json(value / by) : ordered_json();
}

int float_lanes(const std::string& target) {
  return target == "avx512" ? 16 : target == "avx2" ? 8 : target == "scalar" ? 1 : 4;
}

// The rate of one thread whose vector ports never wait.
double bound_mray_per_s(const KindResult& kind, const Measured& measured) {
  return measured.cycles_per_s / kind.least.cycles(float_lanes(measured.target)) / 1e6;
}

std::string text_of_bounds(const Measured& measured, const BenchOptions& options) {
  std::string text =
      fmt::format("\nLeast work per ray, at {:.2f} GHz:\n{:<16}{:>8}{:>8}{:>12}{:>12}{:>12}{:>8}{:>8}{:>13}{:>9}\n",
                  measured.cycles_per_s / 1e9, "", "nodes", "leaves", "in order:", "nodes", "leaves", "cand.", "bytes",
                  "bound", "reached");
  for (const KindResult& kind : measured.kinds) {
    if (kind.rays == 0 || !has_bound(kind.facts.kind)) continue;
    const LeastWork& least = kind.least;
    const double bound = bound_mray_per_s(kind, measured);
    text +=
        fmt::format("{:<16}{:>8.2f}{:>8.2f}{:>24.2f}{:>12.2f}{:>8.2f}{:>8.0f}{:>9.4g} M/s{:>8.0f}%\n", kind.facts.name,
                    least.nodes, least.leaves, least.nodes_in_order, least.leaves_in_order, least.candidates,
                    least.bytes, bound, 100 * kind.mray_per_s() / bound / static_cast<double>(options.threads));
  }
  return text;
}

ordered_json json_of_bound(const KindResult& kind, const Measured& measured) {
  const LeastWork& least = kind.least;
  return {{"nodes", least.nodes},
          {"leaves", least.leaves},
          {"nodes_in_order", least.nodes_in_order},
          {"leaves_in_order", least.leaves_in_order},
          {"candidates", least.candidates},
          {"bytes", least.bytes},
          {"mray_per_s", bound_mray_per_s(kind, measured)}};
}

}  // namespace

std::string json_report(const Measured& measured, const BenchOptions& options) {
  const BuildResult& build = measured.build;
  ordered_json json;
  json["input"] = measured.description;
  json["spheres"] = measured.spheres;
  json["threads"] = options.threads;
  json["target"] = measured.target;
  json["commit"] = commit();
  json["machine"] = machine();
  json["reps"] = options.reps;
  json["build_ms"] = positive(build.ours.again_ms);
  json["build_fresh_ms"] = positive(build.ours.fresh_ms);
  json["build_peak_bytes"] = build.peak_bytes;
  json["bytes_per_sphere"] = build.bytes_per_sphere;
  json["levels"] = build.levels;
  json["nodes"] = build.nodes;
  json["frame_ms"] = positive(measured.frame.ms);
  json["frame_rays"] = measured.frame.rays;

  ordered_json rates = ordered_json::object(), peer_rates = rates, ratios = rates, rays = rates, tiles = rates,
               modes = rates;
  std::int64_t wrong = 0, peer_wrong = 0, differ = 0;
  ratios["build"] = quotient(build.peer.best_ms(), build.ours.again_ms);
  ratios["build_fresh"] = quotient(build.peer.fresh_ms, build.ours.fresh_ms);
  ratios["bytes"] = quotient(build.peer_bytes_per_sphere, build.bytes_per_sphere);
  for (const KindResult& kind : measured.kinds) {
    const std::string name(kind.facts.name);
    rays[name] = kind.rays;
    tiles[name] = kind.tile;
    rates[name] = kind.ms > 0 ? ordered_json(kind.mray_per_s()) : ordered_json();
    peer_rates[name] = kind.peer_ms > 0 ? ordered_json(kind.peer_mray_per_s()) : ordered_json();
    modes[name] = kind.peer_mode;
    ratios[name] = quotient(kind.peer_ms, kind.ms);
    wrong += kind.verdict.ours_wrong;
    peer_wrong += kind.verdict.peer_wrong;
    differ += kind.verdict.differ;
  }
  json["rays"] = rays;
  json["tile"] = tiles;
  json["mray_per_s"] = rates;
  if (options.embree) {
    json["peer"] = {{"name", "embree"},
                    {"version", measured.peer_version},
                    {"build_ms", positive(build.peer.best_ms())},
                    {"build_fresh_ms", positive(build.peer.fresh_ms)},
                    {"bytes_per_sphere", build.peer_bytes_per_sphere},
                    {"mray_per_s", peer_rates},
                    {"mode", modes}};
    json["ratio"] = ratios;
    json["differ"] = differ;
    json["peer_wrong"] = peer_wrong;
  } else {
    json["peer"] = nullptr;
    json["ratio"] = nullptr;
  }
  if (measured.cycles_per_s > 0) {
    json["cycles_per_s"] = measured.cycles_per_s;
    json["bound"] = ordered_json::object();
    for (const KindResult& kind : measured.kinds)
      if (kind.rays > 0 && has_bound(kind.facts.kind))
        json["bound"][std::string(kind.facts.name)] = json_of_bound(kind, measured);
  }
  json["mismatches"] = wrong;
  return json.dump(2, ' ', /*ensure_ascii=*/true, ordered_json::error_handler_t::replace) + "\n";
}

std::string text_report(const Measured& measured, const BenchOptions& options) {
  const BuildResult& build = measured.build;
  const bool peer = options.embree;
  std::string text = fmt::format("{}: {} spheres, {} thread{}, {}\n", measured.description, grouped(measured.spheres),
                                 options.threads, options.threads == 1 ? "" : "s", measured.target);
  text += fmt::format("{:<16}{:>10}{:>14}", "", "rays", "bihive");
  if (peer) text += fmt::format("{:>14}{:>9}   {}", "Embree " + measured.peer_version, "ratio", "its mode");
  text += "\n";
  const auto row = [&](const std::string& name, const std::string& rays, double ours, double theirs, double ratio,
                       const std::string& unit, const std::string& mode) {
    text += fmt::format("{:<16}{:>10}{:>14}", name, rays, fmt::format("{:.4g} {}", ours, unit));
    if (peer) text += fmt::format("{:>14}{:>8.2f}x   {}", fmt::format("{:.4g} {}", theirs, unit), ratio, mode);
    text += "\n";
  };
  if (options.build) {
    row("build again", "", build.ours.again_ms, build.peer.again_ms, build.peer.again_ms / build.ours.again_ms, "ms",
        "");
    row("build fresh", "", build.ours.fresh_ms, build.peer.fresh_ms, build.peer.fresh_ms / build.ours.fresh_ms, "ms",
        "");
  }
  row("memory", "", build.bytes_per_sphere, build.peer_bytes_per_sphere,
      build.peer_bytes_per_sphere / build.bytes_per_sphere, "B", "a sphere");
  std::int64_t wrong = 0, peer_wrong = 0;
  for (const KindResult& kind : measured.kinds) {
    const std::string rays = grouped(kind.rays);
    if (kind.rays == 0) continue;
    row(std::string(kind.facts.name), rays, kind.mray_per_s(), kind.peer_mray_per_s(), kind.peer_ms / kind.ms, "M/s",
        kind.peer_mode);
    wrong += kind.verdict.ours_wrong;
    peer_wrong += kind.verdict.peer_wrong;
  }
  const FrameResult& frame = measured.frame;
  if (frame.ms > 0)
    text += fmt::format("{:<16}{:>10}{:>14}   a picture of {} x {} pixels, shadows, recursion 5\n", "frame",
                        grouped(frame.rays), fmt::format("{:.4g} ms", frame.ms), frame.width_px, frame.height_px);
  text += fmt::format("wrong answers: {}", wrong);
  if (peer) text += fmt::format(", Embree's {}", peer_wrong);
  text += "\n";
  if (measured.cycles_per_s > 0) text += text_of_bounds(measured, options);
  return text;
}

}  // namespace bihive::bench
