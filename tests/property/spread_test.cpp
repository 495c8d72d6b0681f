// Pictures of spheres that lie on several ranks have the same bits as those of one process that has them all.
#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "bihive/render/renderer.h"
#include "bihive/spread/spread_scene.h"
#include "support/effort.h"
#include "support/random_scene.h"
#include "support/ranks_here.h"

namespace bihive {
namespace {

// A scene on ranks that are threads of this process.
class RanksHere {
 public:
  /// `first_of_all`: rank 0 has all spheres at first; else each rank has some that follow each other.
  RanksHere(const Scene& whole, const RenderSettings& settings, int ranks, bool first_has_all)
      : meeting_(ranks), scenes_(static_cast<std::size_t>(ranks)) {
    std::vector<std::thread> threads;
    for (int rank = 0; rank < ranks; ++rank)
      threads.emplace_back([&, rank] {
        test::RankThread here(rank, meeting_);
        Scene mine = test::part_of_scene(whole, first_has_all ? (rank == 0 ? 0 : 1) : rank, first_has_all ? 1 : ranks);
        scenes_[static_cast<std::size_t>(rank)] =
            SpreadScene::make(std::move(mine), settings, {}, here).value();
      });
    for (std::thread& thread : threads) thread.join();
  }

  Rendered draw(int rank, RenderSettings settings) {
    test::LocalExchange exchange(rank, scenes_);
    const std::unique_ptr<SpreadScene::Artist> artist = scenes_[static_cast<std::size_t>(rank)]->artist(exchange);
    settings.threads = 1;
    return render(artist->scene(), artist->tracer(), settings).value();
  }

 private:
  test::Meeting meeting_;
  std::vector<std::shared_ptr<const SpreadScene>> scenes_;
};

void expect_same(const Rendered& expected, const Rendered& drawn, const std::string& what) {
  ASSERT_EQ(expected.film.radiance.size(), drawn.film.radiance.size());
  EXPECT_EQ(std::memcmp(expected.film.radiance.data(), drawn.film.radiance.data(),
                        drawn.film.radiance.size() * sizeof(Vec3f)),
            0)
      << what;
  EXPECT_EQ(expected.rays.primary, drawn.rays.primary) << what;
  EXPECT_EQ(expected.rays.shadow, drawn.rays.shadow) << what;
  EXPECT_EQ(expected.rays.reflected, drawn.rays.reflected) << what;
  EXPECT_EQ(expected.rays.transmitted, drawn.rays.transmitted) << what;
  EXPECT_EQ(expected.rays.ambient, drawn.rays.ambient) << what;
}

TEST(Spread, pictures_are_those_of_one_process) {
  const std::uint64_t step = test::ray_share() > 1 ? 11 : 1;
  for (std::uint64_t seed = 1; seed <= 60; seed += step) {
    Scene scene = test::random_scene(seed);
    scene.clips.clear();
    scene.spheres.attributes().clips.clear();
    const RenderSettings settings = test::random_settings(seed);
    const Rendered expected = render(scene, Tracer::build(scene, Engine::wide).value(), settings).value();
    for (const int ranks : {1, 2, 3, 4, 7, 8, 100}) {
      RanksHere here(scene, settings, ranks, seed % 2 == 0);
      expect_same(expected, here.draw(static_cast<int>(seed) % ranks, settings),
                  scene.name + " on " + std::to_string(ranks) + " ranks");
      if (::testing::Test::HasFailure()) return;
    }
  }
}

}  // namespace
}  // namespace bihive
