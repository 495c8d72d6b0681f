#include "bihive/simd/target.h"

#include <hwy/highway.h>
#include <hwy/targets.h>

#include <cstdint>
#include <cstdlib>

#include "bihive/simd/dispatch.h"

// WebAssembly and AArch64 have one: nothing to choose, and no need of Highway's compiled part.
#define BIHIVE_ONE_TARGET (HWY_TARGETS == HWY_STATIC_TARGET)

namespace bihive {
namespace {

struct NamedTarget {
  std::int64_t bit;
  const char* name;
};
// Best first. `scalar` is whatever the compiler has without asking, where it has no better name: Highway's emulation of
// vectors.
constexpr NamedTarget kNames[] = {{HWY_AVX3, "avx512"}, {HWY_AVX2, "avx2"}, {HWY_SSE4, "sse4"},
                                  {HWY_NEON, "neon"},   {HWY_WASM, "wasm"}, {HWY_STATIC_TARGET, "scalar"}};

// Targets that are compiled and that this machine can run, as Highway's bits.
std::int64_t runnable() {
#if BIHIVE_ONE_TARGET
  return HWY_STATIC_TARGET;
#else
  // Asking Highway undoes the choice of a target, so it is asked once, before the first choice.
  static const std::int64_t bits = (hwy::SupportedTargets() & HWY_TARGETS) | HWY_STATIC_TARGET;
  return bits;
#endif
}

// Whether this machine can run it, and no better name stands for the same target.
bool is_available(const NamedTarget& target) {
  for (const NamedTarget& better : kNames) {
    if (&better == &target) break;
    if (better.bit == target.bit) return false;
  }
  return (runnable() & target.bit) != 0;
}

std::int64_t bit_of(const std::string& name) {
  for (const NamedTarget& target : kNames)
    if (name == target.name && is_available(target)) return target.bit;
  return 0;
}

std::string& current_name() {
  static std::string name;
  return name;
}

// "" is the best. False if there is no such target.
bool choose(const std::string& name) {
  const std::string wanted = name.empty() ? available_targets().front() : name;
  const std::int64_t bit = bit_of(wanted);
  if (bit == 0) return false;
#if !BIHIVE_ONE_TARGET
  hwy::GetChosenTarget().Update(bit);
#endif
  current_name() = wanted;
  return true;
}

}  // namespace

bool choose_first_target() {
  static const bool chosen = [] {
    const char* request = std::getenv("BIHIVE_TARGET");
    if (request == nullptr || !choose(request)) choose("");
    return true;
  }();
  return chosen;
}

std::vector<std::string> available_targets() {
  std::vector<std::string> names;
  for (const NamedTarget& target : kNames)
    if (is_available(target)) names.push_back(target.name);
  return names;
}

std::string active_target() {
  ensure_target();
  return current_name();
}

Status use_target(const std::string& name) {
  ensure_target();
  if (choose(name)) return Done{};
  std::string all;
  for (const std::string& known : available_targets()) all += (all.empty() ? "" : ", ") + known;
  return Error{"this machine cannot run the target '" + name + "'", "", 0, 0, "choose one of: " + all};
}

Status check_target_environment() {
  const char* request = std::getenv("BIHIVE_TARGET");
  if (request == nullptr || request == active_target()) return Done{};
  Status status = use_target(request);
  if (!status) return Error{"BIHIVE_TARGET: " + status.error().message, "", 0, 0, status.error().hint};
  return status;
}

}  // namespace bihive
