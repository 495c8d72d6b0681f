// The engine that answers the rays of the differential test: the real program by way of files, or the library directly.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "bihive/base/parallel.h"
#include "bihive/geometry/ray.h"
#include "bihive/render/tracer.h"
#include "bihive/simd/target.h"
#include "support/npy_file.h"
#include "support/world.h"

namespace bihive::test {

struct Answers {
  std::vector<double> t;
  std::vector<std::int64_t> id;
};

/// Empty answers mean that the engine failed; the reason has been printed. `target` is one of available_targets()
/// (simd/target.h), or empty for the library's own choice.
class EngineUnderTest {
 public:
  virtual ~EngineUnderTest() = default;
  virtual bool load(const World& world) = 0;
  virtual bool set_rays(const std::vector<Ray>& rays) = 0;
  virtual std::optional<Answers> trace(const std::string& engine, bool any, const std::string& target = "") = 0;
};

/// `bihive trace`, run as its users run it.
class ProgramUnderTest : public EngineUnderTest {
 public:
  ProgramUnderTest(std::string program, std::string folder) : program_(std::move(program)), folder_(std::move(folder)) {
    std::filesystem::create_directories(folder_);
  }
  ~ProgramUnderTest() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  bool load(const World& world) override {
    std::vector<float> values;
    for (std::size_t i = 0; i < world.size(); ++i)
      values.insert(values.end(), {world.x[i], world.y[i], world.z[i], world.r[i]});
    return write_npy(file("spheres"), "<f4", values, 4);
  }

  bool set_rays(const std::vector<Ray>& rays) override {
    count_ = rays.size();
    std::vector<float> values;
    values.reserve(8 * rays.size());
    for (const Ray& ray : rays)
      values.insert(values.end(), {ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x, ray.direction.y,
                                   ray.direction.z, static_cast<float>(ray.t_min), static_cast<float>(ray.t_max)});
    return write_npy(file("rays"), "<f4", values, 8);
  }

  std::optional<Answers> trace(const std::string& engine, bool any, const std::string& target) override {
    const std::string command = (target.empty() ? "'" : "BIHIVE_TARGET=" + target + " '") + program_ + "' trace '" +
                                file("spheres") + "' --rays '" + file("rays") + "' --t '" + file("t") + "' --id '" +
                                file("id") + "' --engine " + engine + (any ? " --any" : "") + " >'" + file("said") +
                                "' 2>&1";
    if (std::system(command.c_str()) != 0) {
      std::ifstream said(file("said"));
      std::stringstream text;
      text << said.rdbuf();
      std::fprintf(stderr, "failed: %s\n%s", command.c_str(), text.str().c_str());
      return std::nullopt;
    }
    Answers answers{read_npy<double>(file("t"), "<f8", count_), read_npy<std::int64_t>(file("id"), "<i8", count_)};
    if (answers.t.size() != count_ || answers.id.size() != count_) {
      std::fprintf(stderr, "not the arrays that were asked for: %s\n", command.c_str());
      return std::nullopt;
    }
    return answers;
  }

 private:
  std::string program_, folder_;
  std::size_t count_ = 0;
  std::string file(const std::string& name) const { return folder_ + "/" + name + (name == "said" ? ".txt" : ".npy"); }
};

/// The same queries without files, to tell a fault of the library from one of the program.
class LibraryUnderTest : public EngineUnderTest {
 public:
  explicit LibraryUnderTest(int threads) : threads_(threads) {}
  bool load(const World& world) override {
    spheres_ = sphere_set(world);
    return true;
  }
  bool set_rays(const std::vector<Ray>& rays) override {
    rays_ = &rays;
    return true;
  }
  std::optional<Answers> trace(const std::string& engine, bool any, const std::string& target) override {
    const Engine asked = engine == "brute"       ? Engine::brute
                         : engine == "reference" ? Engine::reference
                                                 : Engine::automatic;
    BIHIVE_CHECK(use_target(target).ok());
    const Tracer tracer = Tracer::build(spheres_, asked, {}, threads_).value();
    Answers answers{std::vector<double>(rays_->size(), std::numeric_limits<double>::infinity()),
                    std::vector<std::int64_t>(rays_->size(), -1)};
    constexpr std::int64_t kBlock = 16384;
    const auto count = static_cast<std::int64_t>(rays_->size());
    parallel_for(threads_, (count + kBlock - 1) / kBlock, [&](std::int64_t block) {
      const std::int64_t first = block * kBlock;
      RayBatch batch;
      for (std::int64_t i = first; i < std::min(first + kBlock, count); ++i)
        batch.push_back((*rays_)[static_cast<std::size_t>(i)]);
      const HitSpan hits = HitSpan{answers.t.data(), answers.id.data()}.part(first);
      if (!any) return tracer.closest_hits(batch.span(), RayOrder::any, hits);
      std::vector<std::uint8_t> hidden(static_cast<std::size_t>(batch.size()));
      tracer.occluded(batch.span(), RayOrder::any, hidden.data());
      for (std::int64_t i = 0; i < batch.size(); ++i)
        if (hidden[static_cast<std::size_t>(i)] != 0) hits.t[i] = 0, hits.sphere_id[i] = 0;
    });
    return answers;
  }

 private:
  int threads_;
  SphereSet spheres_;
  const std::vector<Ray>* rays_ = nullptr;
};

}  // namespace bihive::test
