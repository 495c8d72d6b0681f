// What is predicted of the memory of trees and pictures, beside what the system measures of this process.
// ctest: no-sanitizer
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>

#include "bihive/bih/memory.h"
#include "bihive/render/memory.h"
#include "bihive/render/renderer.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/load_scene.h"
#include "bihive/wide/wide_builder.h"
#include "support/hostile_sets.h"

// Sanitizers keep freed memory.
#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

namespace bihive {
namespace {

constexpr double kMostFactor = 1.5;

double status_bytes(const char* name) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);)
    if (line.rfind(name, 0) == 0) return 1024 * std::strtod(line.c_str() + std::strlen(name), nullptr);
  return 0;
}

// The most that `work` takes beside what is held before it; below 0 if the system does not say.
template <class Work>
double measured_peak(const Work& work) {
  // What is freed goes back to the system, so that it does not serve the next work unseen.
  mallopt(M_MMAP_THRESHOLD, 128 << 10);
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";
  const double before = status_bytes("VmRSS:");
  if (status_bytes("VmHWM:") > before + (1 << 20)) return -1;
  work();
  return status_bytes("VmHWM:") - before;
}

void expect_near(double predicted, double measured, const std::string& what) {
  if (measured < 0) GTEST_SKIP() << "the system does not forget the peak of this process";
  std::printf("%s: predicted %.1f MB, measured %.1f MB, factor %.2f\n", what.c_str(), predicted / 1e6, measured / 1e6,
              predicted / measured);
  EXPECT_LE(predicted, kMostFactor * measured) << what;
  EXPECT_GE(kMostFactor * predicted, measured) << what;
}

TEST(MemoryPrediction, TreesTakeWhatIsPredicted) {
  for (const bool one_radius : {true, false})
    for (const int count : {200'000, 600'000}) {
      const SphereSet spheres =
          test::sphere_set(test::random_world("random", 4, count, 10, 0.02, one_radius ? 0.02 : 0.2));
      for (const Engine engine : {Engine::wide, Engine::reference}) {
        const double measured =
            measured_peak([&] { EXPECT_TRUE(Tracer::build(spheres, engine, TreeParameters{}, 2).ok()); });
        expect_near(predict_tree_bytes(count, engine, {}).peak, measured,
                    std::to_string(count) + " spheres, " + (engine == Engine::wide ? "wide" : "reference") +
                        (one_radius ? ", one radius" : ", many radii"));
      }
    }
}

TEST(MemoryPrediction, FilmsTakeWhatIsPredicted) {
  if (testing::UnitTest::GetInstance()->test_suite_to_run_count() > 1)
    GTEST_SKIP() << "threads of other tests hold memory: --file unit/memory_prediction has a process of its own";
  const Result<LoadedScene> loaded = built_in_scene("four-spheres", {}, {}, nullptr);
  ASSERT_TRUE(loaded.ok());
  const Result<Tracer> tracer = Tracer::build(loaded->scene, Engine::wide);
  ASSERT_TRUE(tracer.ok());
  const auto measured_of = [&](const RenderSettings& settings) {
    return measured_peak([&] { EXPECT_TRUE(render(loaded->scene, *tracer, settings).ok()); });
  };

  // Threads keep their buffers, so they count in the first picture alone.
  RenderSettings small;
  small.width_px = 512;
  small.height_px = 256;
  small.threads = 2;
  expect_near(predict_film_bytes(small, 512.0 * 256) + predict_thread_bytes(small), measured_of(small),
              "the buffers of two threads");
  measured_of(small);
  for (const bool transparent : {false, true})
    for (const int height : {1000, 2000}) {
      RenderSettings settings;
      settings.width_px = 1000;
      settings.height_px = height;
      settings.threads = 2;
      settings.transparent = transparent;
      // On a busy machine a thread may get its first tile, and with it its buffers, here: then the second picture
      // counts.
      const double measured = std::min(measured_of(settings), measured_of(settings));
      expect_near(predict_film_bytes(settings, 1000.0 * height), measured,
                  "a film of 1000 x " + std::to_string(height) + (transparent ? ", transparent" : ""));
    }
}

}  // namespace
}  // namespace bihive

#endif
