// Whoever watches long work hears of its progress and can end it.
#include "bihive/base/watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "bihive/base/parallel.h"
#include "bihive/base/write_file.h"
#include "bihive/io/frames.h"
#include "bihive/io/read_spheres.h"
#include "bihive/render/renderer.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/generators.h"
#include "bihive/scene/load_scene.h"
#include "bihive/wide/periodic_images.h"
#include "bihive/wide/point_queries.h"
#include "bihive/wide/queries.h"
#include "bihive/wide/wide_builder.h"
#include "support/effort.h"
#include "support/thread_time.h"

namespace bihive {
namespace {

// What a callback hears: numbers that grow from 0 to 1.
struct Heard {
  std::vector<double> shares;

  ProgressCallback callback() {
    return [this](double done) { shares.push_back(done); };
  }
  // With reports before the end: how many depends on the machine, because some 20 ms lie between them. A fast one once
  // heard three of a reading of a million atoms.
  void expect_one_call() const {
    ASSERT_GT(shares.size(), 1u);
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
}

TEST(Watch, a_build_reports_and_ends_with_1) {
  const SphereSet set = many_spheres(2000000);
  for (const int threads : {1, 2}) {
    Heard heard;
    const Watch watch(heard.callback());
    ASSERT_TRUE(WideBuilder().build(set, {}, threads).ok());
    heard.expect_one_call();
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

// Every query of rays and points that can be watched, on one thread or two.
struct Queries {
  SphereSet set;
  std::shared_ptr<const WideTree> tree;
  std::optional<PeriodicImages> images;
  RayBatch rays;
  std::vector<double> points;

  explicit Queries(std::size_t spheres, std::size_t count) : set(many_spheres(spheres)) {
    set.cell() = Cell{{}, {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}};
    tree = WideBuilder().build(set).value();
    images = PeriodicImages::of(set).value();
    rays.resize(static_cast<std::int64_t>(count));
    rays.t_max.assign(count, 1.5);
    std::uint32_t state = 7;
    const auto random = [&state] {
      state = state * 1664525U + 1013904223U;
      return static_cast<float>(state >> 8) * 0x1p-24F;
    };
    for (std::size_t i = 0; i < count; ++i)
      for (int axis = 0; axis < 3; ++axis) {
        rays.origin[axis][i] = random();
        rays.direction[axis][i] = random() - 0.5F;
        points.push_back(double(random()));
      }
  }

  using Query = std::function<std::optional<Error>()>;
  std::vector<std::pair<std::string, Query>> all(int threads) const {
    const auto error_of = [](const auto& result) { return result ? std::optional<Error>() : result.error(); };
    const auto span = PointSpan::rows(points.data(), rays.size());
    std::vector<std::pair<std::string, Query>> list;
    for (const PeriodicImages* const seen : {static_cast<const PeriodicImages*>(nullptr), &*images}) {
      const std::string among = seen != nullptr ? ", periodic" : "";
      const RayOptions options{RayOrder::any, threads, seen, nullptr};
      const PointOptions of_points{DistanceTo::surface, nullptr, threads, seen, nullptr};
      list.emplace_back("closest" + among, [=, this] {
        HitBatch hits;
        hits.resize(rays.size());
        return error_of(closest_hits(*tree, rays.span(), hits.span(), options));
      });
      list.emplace_back("occluded" + among, [=, this] {
        std::vector<std::uint8_t> hidden(static_cast<std::size_t>(rays.size()));
        return error_of(occluded(*tree, rays.span(), hidden.data(), options));
      });
      list.emplace_back("all hits" + among, [=, this] {
        std::vector<RayHit> hits;
        return error_of(all_hits(*tree, rays.span(), hits, options));
      });
      list.emplace_back("nearest" + among, [=, this] {
        return error_of(nearest_spheres(*tree, span, 8, std::numeric_limits<double>::infinity(), of_points));
      });
      list.emplace_back("within" + among, [=, this] { return error_of(spheres_within(*tree, span, 0.02, of_points)); });
      list.emplace_back("numbers within" + among, [=, this] {
        const std::vector<double> limits(static_cast<std::size_t>(span.count), 0.02);
        return error_of(count_within(*tree, span, limits.data(), of_points));
      });
      list.emplace_back("pairs" + among, [=, this] { return error_of(sphere_pairs(*tree, set, 0.02, of_points)); });
    }
    return list;
  }
};

TEST(Watch, queries_report_and_end_with_1) {
  const Queries queries(20000, 40000 / static_cast<std::size_t>(test::ray_share()));
  for (const int threads : {1, 2})
    for (const auto& [name, query] : queries.all(threads)) {
      SCOPED_TRACE(name);
      Heard heard;
      std::thread::id looked;
      const Watch watch(heard.callback(), nullptr, [&](double) {
        looked = std::this_thread::get_id();
        return true;
      });
      EXPECT_FALSE(query().has_value());
      if (!heard.shares.empty()) heard.expect_one_call();
      EXPECT_TRUE(looked == std::thread::id() || looked == std::this_thread::get_id());
    }
}

TEST(Watch, cancelled_queries_give_an_error_of_their_own) {
  const Queries queries(2000, 5000);
  for (const int threads : {1, 2})
    for (const auto& [name, query] : queries.all(threads)) {
      SCOPED_TRACE(name);
      CancelToken stop;
      stop.cancel();
      {
        const Watch watch({}, &stop);
        const std::optional<Error> error = query();
        ASSERT_TRUE(error.has_value());
        EXPECT_TRUE(is_cancelled(*error)) << error->to_string();
      }
      EXPECT_FALSE(query().has_value());
    }
}

// From the cancel to the end: at most some 50 ms of work on each thread.
TEST(Watch, a_cancelled_query_ends_soon) {
  const Queries queries(200000, 3000000 / static_cast<std::size_t>(test::ray_share()));
  for (const auto& [name, query] : queries.all(1)) {
    SCOPED_TRACE(name);
    double at_cancel = 0;
    const Watch watch({}, nullptr, [&](double) {
      at_cancel = test::thread_time_ms();
      return false;
    });
    const std::optional<Error> error = query();
    const double took = test::thread_time_ms() - at_cancel;
    if (!error) continue;  // it was too fast
    EXPECT_TRUE(is_cancelled(*error)) << error->to_string();
    EXPECT_LT(took, 50.0 * static_cast<double>(test::test_share()));
  }
}

TEST(Watch, queries_on_threads_have_the_answers_of_those_on_one) {
  const Queries queries(2000, 9000);
  const RaySpan rays = queries.rays.span();
  HitBatch one, some;
  one.resize(rays.count);
  some.resize(rays.count);
  std::vector<std::uint8_t> hidden(static_cast<std::size_t>(rays.count)), other(hidden);
  std::vector<RayHit> all, of_all;
  closest_hits(*queries.tree, rays, RayOrder::any, one.span());
  occluded(*queries.tree, rays, RayOrder::any, hidden.data());
  all_hits(*queries.tree, rays, all);
  const auto same = [](const RayHit& a, const RayHit& b) {
    return a.ray == b.ray && a.t == b.t && a.sphere_id == b.sphere_id;
  };
  for (const RayOrder order : {RayOrder::any, RayOrder::blocks})
    for (const int threads : {0, 1, 3, 200}) {
      const RayOptions options{order, threads, nullptr, nullptr};
      ASSERT_TRUE(closest_hits(*queries.tree, rays, some.span(), options).ok());
      ASSERT_TRUE(occluded(*queries.tree, rays, other.data(), options).ok());
      ASSERT_TRUE(all_hits(*queries.tree, rays, of_all, options).ok());
      EXPECT_EQ(some.t, one.t);
      EXPECT_EQ(some.sphere_id, one.sphere_id);
      EXPECT_EQ(other, hidden);
      EXPECT_TRUE(std::equal(all.begin(), all.end(), of_all.begin(), of_all.end(), same));
    }
  // No rays, and with images the first ray without an end.
  ASSERT_TRUE(closest_hits(*queries.tree, {}, {}).ok());
  ASSERT_TRUE(all_hits(*queries.tree, {}, of_all, {}).ok());
  EXPECT_TRUE(of_all.empty());
  RayBatch endless;
  endless.push_back({{0, 0, 0}, {1, 0, 0}, 0, 1});
  endless.push_back({{0, 0, 0}, {1, 0, 0}});
  const Status status = all_hits(*queries.tree, endless.span(), of_all, {RayOrder::any, 2, &*queries.images, nullptr});
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().to_string().find("ray 1 passes"), std::string::npos) << status.error().to_string();
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
