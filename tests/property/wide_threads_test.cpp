// The wide engine from several threads: queries beside queries, and beside the build of the next frame's tree.
// ctest: threads
#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "support/query_rays.h"
#include "support/scenes.h"
#include "support/wide_under_test.h"

namespace bihive {
namespace {

using TreePointer = std::shared_ptr<const WideTree>;

// Spheres of one frame, rays, and the answers by the reference.
struct Frame {
  SphereSet spheres;
  RayBatch rays;
  std::vector<Hit> truths;
};

Frame frame(std::uint64_t number) {
  const test::World world = test::random_world("frame", number, 500 + 700 * static_cast<int>(number), 10, 0.1, 0.8);
  Frame made{test::sphere_set(world), {}, {}};
  const Tree tree = build_reference_tree(made.spheres, {});
  const auto closest = [&](const Ray& ray) { return closest_hit(tree, made.spheres, ray); };
  for (const Ray& ray : test::blocks_of_rays(world, number, 8, closest)) made.rays.push_back(ray);
  test::QueryRays strange(world, number, closest);
  for (int i = 0; i < 500; ++i) made.rays.push_back(strange.next());
  for (std::int64_t i = 0; i < made.rays.size(); ++i) made.truths.push_back(closest(made.rays.span().at(i)));
  return made;
}

// The number of answers that differ from the reference's.
std::int64_t wrong_answers(const WideTree& tree, const Frame& frame, RayOrder order) {
  HitBatch hits;
  hits.resize(frame.rays.size());
  std::vector<std::uint8_t> hidden(static_cast<std::size_t>(frame.rays.size()));
  closest_hits(tree, frame.rays.span(), order, hits.span());
  occluded(tree, frame.rays.span(), order, hidden.data());
  std::int64_t wrong = 0;
  for (std::int64_t i = 0; i < frame.rays.size(); ++i) {
    const Hit& truth = frame.truths[static_cast<std::size_t>(i)];
    wrong += test::same_bits(hits.at(i), truth) ? 0 : 1;
    wrong += (hidden[static_cast<std::size_t>(i)] != 0) == truth.found() ? 0 : 1;
    if (i % 16 == 0) wrong += test::same_bits(closest_hit(tree, frame.rays.span().at(i)), truth) ? 0 : 1;
  }
  return wrong;
}

TEST(WideThreads, QueriesGoOnWhileTheNextTreeIsBuilt) {
  constexpr int kFrames = 3;
  std::vector<Frame> frames;
  for (std::uint64_t number = 0; number < kFrames; ++number) frames.push_back(frame(number));

  // One thread builds frame after frame and hands out the newest tree; three threads trace the newest one.
  WideBuilder builder;
  std::mutex mutex;
  std::pair<TreePointer, int> newest{*builder.build(frames[0].spheres), 0};
  std::atomic<bool> done{false};
  std::atomic<std::int64_t> wrong{0}, rounds{0};
  std::vector<std::thread> threads;
  for (int worker = 0; worker < 3; ++worker)
    threads.emplace_back([&, worker] {
      do {
        std::pair<TreePointer, int> held;
        {
          const std::lock_guard<std::mutex> lock(mutex);
          held = newest;
        }
        wrong += wrong_answers(*held.first, frames[static_cast<std::size_t>(held.second)],
                               worker % 2 == 0 ? RayOrder::any : RayOrder::blocks);
        ++rounds;
      } while (!done);
    });
  for (int built = 1; built <= 30 || rounds < 12; ++built) {
    const int number = built % kFrames;
    Result<TreePointer> tree = builder.build(frames[static_cast<std::size_t>(number)].spheres, {}, 1 + built % 2);
    BIHIVE_CHECK(tree.ok());
    const std::lock_guard<std::mutex> lock(mutex);
    newest = {*tree, number};
  }
  done = true;
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
  EXPECT_GE(rounds, 12);
}

TEST(WideThreads, ManyThreadsOnOneTree) {
  const Frame one = frame(2);
  WideBuilder builder;
  const TreePointer tree = *builder.build(one.spheres);
  std::atomic<std::int64_t> wrong{0};
  std::vector<std::thread> threads;
  for (int worker = 0; worker < 8; ++worker)
    threads.emplace_back(
        [&, worker] { wrong += wrong_answers(*tree, one, worker % 2 == 0 ? RayOrder::any : RayOrder::blocks); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

TEST(WideThreads, TheLastHolderMayBeAnyThread) {
  const Frame one = frame(1);
  std::int64_t wrong = 0;
  std::thread tracing;
  {
    WideBuilder builder;
    TreePointer tree = *builder.build(one.spheres);
    tracing = std::thread([&one, &wrong, held = std::move(tree)]() mutable {
      wrong = wrong_answers(*held, one, RayOrder::any);
      held.reset();
    });
    // The builder goes on, and goes away, while the other thread holds the tree.
    for (int i = 0; i < 3; ++i) BIHIVE_CHECK(builder.build(one.spheres).ok());
  }
  tracing.join();
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace bihive
