// Pictures of spheres that lie on several ranks have the same bits as those of one process that has them all.
#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "bihive/render/renderer.h"
#include "bihive/spread/local_exchange.h"
#include "bihive/spread/sphere_keys.h"
#include "bihive/spread/spheres_elsewhere.h"
#include "bihive/spread/stand_ins.h"
#include "support/effort.h"
#include "support/random_scene.h"

namespace bihive {
namespace {

// A scene on ranks that are all in this process.
struct SpreadScene {
  Scene shell;
  SphereColumns has;
  std::vector<std::shared_ptr<const PartOfSet>> parts;
  std::vector<RankBox> boxes;
  Bytes stand_ins;

  SpreadScene(const Scene& whole, const RenderSettings& settings, int ranks)
      : shell(without_spheres(whole)), has(SphereColumns::of(whole)) {
    std::vector<SphereKey> keys;
    std::vector<std::int64_t> own_ids;
    for (std::int64_t id = 0; id < whole.spheres.size(); ++id) {
      keys.push_back(key_of(whole.spheres, id));
      own_ids.push_back(id);
    }
    for (const std::vector<std::int64_t>& ids : ids_of_ranks(whole.spheres, starts_of_ranks(keys, ranks))) {
      Bytes packed;
      pack_spheres(whole, has, own_ids, ids, packed);
      Scene scene = shell;
      std::vector<std::int64_t> whole_ids;
      ByteReader reader(packed);
      append_spheres(reader, has, scene, whole_ids);
      boxes.push_back(box_of(scene.spheres));
      parts.push_back(
          PartOfSet::make(std::move(scene), std::move(whole_ids), has, settings.opacity_rule, {}, 1).value());
    }
    pack_spheres(whole, has, own_ids, bihive::stand_ins(whole, settings), stand_ins);
  }

  Rendered draw(int rank, RenderSettings settings) const {
    SeenSpheres seen(shell, has, stand_ins);
    LocalExchange exchange(rank, parts);
    const RankBoxes ranks(boxes, shell.spheres.scale());
    const Tracer tracer(
        seen.scene().spheres,
        std::make_shared<SpheresElsewhere>(seen, ranks, *parts[static_cast<std::size_t>(rank)], exchange), false);
    settings.threads = 1;
    return render(seen.scene(), tracer, settings).value();
  }
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
      const SpreadScene spread(scene, settings, ranks);
      expect_same(expected, spread.draw(static_cast<int>(seed) % ranks, settings),
                  scene.name + " on " + std::to_string(ranks) + " ranks");
      if (::testing::Test::HasFailure()) return;
    }
  }
}

}  // namespace
}  // namespace bihive
