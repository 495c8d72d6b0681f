// Whoever watches long work hears of its progress and can end it.
#include "bihive/base/watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "bihive/base/parallel.h"
#include "bihive/base/write_file.h"
#include "bihive/io/frames.h"
#include "bihive/io/read_spheres.h"
#include "bihive/render/renderer.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/generators.h"
#include "bihive/scene/load_scene.h"
#include "bihive/wide/queries.h"
#include "bihive/wide/wide_builder.h"

namespace bihive {
namespace {

// What a callback hears: numbers that grow from 0 to 1.
struct Heard {
  std::vector<double> shares;

  ProgressCallback callback() {
    return [this](double done) { shares.push_back(done); };
  }
  void expect_one_call() const {
    ASSERT_FALSE(shares.empty());
    EXPECT_GE(shares.front(), 0);
    for (std::size_t i = 1; i < shares.size(); ++i) EXPECT_LE(shares[i - 1], shares[i]);
    EXPECT_EQ(shares.back(), 1);
  }
};

SphereSet many_spheres(std::size_t count) {
  std::vector<float> x(count), y(count), z(count), r(count, 0.01F);
  std::uint32_t state = 1;
  const auto random = [&state] {
    state = state * 1664525U + 1013904223U;
    return static_cast<float>(state >> 8) * 0x1p-24F;
  };
  for (std::size_t i = 0; i < count; ++i) x[i] = random(), y[i] = random(), z[i] = random();
  return SphereSet::from_world(x, y, z, r).value();
}

std::string xyz_text(int atoms) {
  std::string text = std::to_string(atoms) + "\n\n";
  for (int i = 0; i < atoms; ++i)
    text +=
        "C " + std::to_string(i % 100) + " " + std::to_string(i / 100 % 100) + " " + std::to_string(i / 10000) + "\n";
  return text;
}

std::string cif_text(int atoms) {
  std::string text =
      "data_x\nloop_\n_atom_site.group_PDB\n_atom_site.type_symbol\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n"
      "_atom_site.Cartn_z\n";
  for (int i = 0; i < atoms; ++i) text += "ATOM C " + std::to_string(i % 100) + " " + std::to_string(i / 100) + " 0\n";
  return text;
}

TEST(Watch, a_reading_reports_and_ends_with_1) {
  const std::string text = xyz_text(1000000);
  Heard heard;
  const Watch watch(heard.callback());
  ASSERT_TRUE(read_spheres_from_memory(text, "a.xyz", {}).ok());
  heard.expect_one_call();
  EXPECT_GT(heard.shares.size(), 3u);
}

TEST(Watch, a_build_reports_and_ends_with_1) {
  const SphereSet set = many_spheres(2000000);
  for (const int threads : {1, 2}) {
    Heard heard;
    const Watch watch(heard.callback());
    ASSERT_TRUE(WideBuilder().build(set, {}, threads).ok());
    heard.expect_one_call();
    EXPECT_GT(heard.shares.size(), 3u);
  }
}

TEST(Watch, the_reference_builder_and_tracers_report_too) {
  const SphereSet set = many_spheres(1500000);
  for (const Engine engine : {Engine::reference, Engine::wide}) {
    Heard heard;
    const Watch watch(heard.callback());
    ASSERT_TRUE(Tracer::build(set, engine).ok());
    heard.expect_one_call();
  }
}

TEST(Watch, a_cancelled_reading_gives_an_error_of_its_own) {
  CancelToken stop;
  stop.cancel();
  for (const auto& [text, name] : {std::pair(xyz_text(5000), "a.xyz"), std::pair(cif_text(5000), "a.cif"),
                                   std::pair(xyz_text(200000), "long.xyz")}) {
    {
      const Watch watch({}, &stop);
      const auto read = read_spheres_from_memory(text, name, {});
      ASSERT_FALSE(read.ok()) << name;
      EXPECT_TRUE(is_cancelled(read.error())) << read.error().to_string();
      const auto loaded = load_scene(text, name);
      ASSERT_FALSE(loaded.ok()) << name;
      EXPECT_TRUE(is_cancelled(loaded.error()));
    }
    EXPECT_TRUE(read_spheres_from_memory(text, name, {}).ok()) << name;
  }
  const auto broken = read_spheres_from_memory("nonsense", "a.xyz", {});
  ASSERT_FALSE(broken.ok());
  EXPECT_FALSE(is_cancelled(broken.error()));
}

TEST(Watch, a_callback_may_cancel_in_the_middle) {
  const std::string text = xyz_text(1000000);
  const SphereSet set = many_spheres(2000000);
  CancelToken stop;
  double last = 0;
  const auto half = [&](double done) {
    last = done;
    if (done > 0.3) stop.cancel();
  };
  {
    const Watch watch(half, &stop);
    const auto read = read_spheres_from_memory(text, "a.xyz", {});
    ASSERT_FALSE(read.ok());
    EXPECT_TRUE(is_cancelled(read.error()));
  }
  EXPECT_LT(last, 1);
  CancelToken again;
  const auto other = [&](double done) {
    last = done;
    if (done > 0.3) again.cancel();
  };
  const Watch watch(other, &again);
  const auto built = WideBuilder().build(set, {}, 2);
  ASSERT_FALSE(built.ok());
  EXPECT_TRUE(is_cancelled(built.error()));
  EXPECT_LT(last, 1);
}

TEST(Watch, a_cancelled_builder_builds_the_same_trees_afterwards) {
  const SphereSet set = many_spheres(200000), small = many_spheres(5000);
  const auto fresh = WideBuilder().build(set).value();
  WideBuilder builder;
  for (const SphereSet* const one : {&set, &small}) {
    CancelToken stop;
    stop.cancel();
    const Watch watch({}, &stop);
    const auto built = builder.build(*one, {}, 2);
    ASSERT_FALSE(built.ok());
    EXPECT_TRUE(is_cancelled(built.error()));
    for (const Engine engine : {Engine::wide, Engine::reference}) {
      const auto tracer = Tracer::build(*one, engine);
      ASSERT_FALSE(tracer.ok());
      EXPECT_TRUE(is_cancelled(tracer.error()));
    }
  }
  const auto built = builder.build(set).value();
  EXPECT_EQ(built->node_count, fresh->node_count);
  for (int i = 0; i < 100; ++i) {
    const Ray ray{{0.01F * static_cast<float>(i), 0.5F, -1}, {0, 0, 1}};
    EXPECT_EQ(closest_hit(*built, ray).sphere_id, closest_hit(*fresh, ray).sphere_id);
    EXPECT_EQ(closest_hit(*built, ray).t, closest_hit(*fresh, ray).t);
  }
}

TEST(Watch, pictures_without_a_token_of_their_own_are_watched) {
  const Scene scene = four_spheres_scene();
  const Tracer tracer = Tracer::build(scene.spheres, Engine::wide).value();
  RenderSettings settings = settings_from(scene.picture);
  settings.width_px = settings.height_px = 400;
  settings.samples_per_pixel = 16;
  settings.adaptive_samples = false;
  const auto plain = render(scene, tracer, settings).value();
  {
    Heard heard, own;
    const Watch watch(heard.callback());
    const auto rendered = render(scene, tracer, settings);
    ASSERT_TRUE(rendered.ok());
    EXPECT_EQ(rendered->film.radiance, plain.film.radiance);
    heard.expect_one_call();
    const std::size_t before = heard.shares.size();
    ASSERT_TRUE(render(scene, tracer, settings, own.callback()).ok());
    EXPECT_EQ(heard.shares.size(), before);
    EXPECT_FALSE(own.shares.empty());
  }
  CancelToken stop, other;
  stop.cancel();
  const Watch watch({}, &stop);
  const auto rendered = render(scene, tracer, settings);
  ASSERT_FALSE(rendered.ok());
  EXPECT_TRUE(is_cancelled(rendered.error()));
  settings.stereo.form = StereoForm::side;
  EXPECT_FALSE(render(scene, tracer, settings).ok());
  EXPECT_TRUE(render(scene, tracer, settings, {}, &other).ok());
}

TEST(Watch, a_cancelled_opening_leaves_no_index) {
  const std::string folder = testing::TempDir() + "bihive_watch_test";
  std::filesystem::create_directories(folder);
  const std::string path = folder + "/frames.xyz";
  ASSERT_TRUE(write_file(path, xyz_text(5000) + xyz_text(5000)).ok());
  {
    CancelToken stop;
    stop.cancel();
    const Watch watch({}, &stop);
    const auto frames = open_frames(path, {}, {true, false});
    ASSERT_FALSE(frames.ok());
    EXPECT_TRUE(is_cancelled(frames.error()));
    const auto bytes = read_file(path);
    ASSERT_FALSE(bytes.ok());
    EXPECT_TRUE(is_cancelled(bytes.error()));
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
  EXPECT_TRUE(open_frames(path, {}, {true, false}).ok());
  std::filesystem::remove_all(folder);
}

TEST(Watch, the_latest_of_a_thread_counts_and_no_other_threads) {
  CancelToken stop;
  stop.cancel();
  const Watch watch({}, &stop);
  const SphereSet set = many_spheres(1000);
  EXPECT_FALSE(WideBuilder().build(set).ok());
  {
    const Watch inner{ProgressCallback{}};
    EXPECT_TRUE(WideBuilder().build(set).ok());
  }
  bool ok = false;
  std::thread([&] { ok = WideBuilder().build(set).ok(); }).join();
  EXPECT_TRUE(ok);
  for (const int threads : {1, 2})
    parallel_for(threads, 2, [&](std::int64_t) { EXPECT_TRUE(WideBuilder().build(set).ok()); });
  EXPECT_FALSE(WideBuilder().build(set).ok());
}

}  // namespace
}  // namespace bihive
