// ctest: asan-long
#include "bihive/gl/tree_textures.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "bihive/bih/reference_builder.h"
#include "bihive/scene/generators.h"

namespace bihive {
namespace {

Scene scene_of(std::int64_t count) {
  return scenario_scene(Scenario::mixed, {count, 1, 3}).value();
}

TEST(TreeTextures, hold_every_sphere_in_leaf_order) {
  const Scene scene = scene_of(5000);
  const Tree tree = build_reference_tree(scene.spheres, {});
  const SceneTextures textures = pack_scene(scene, &tree, 2048).value();
  ASSERT_EQ(textures.sphere_count, 5000);
  EXPECT_EQ(textures.spheres.height(), 3);
  // Within a leaf, ids ascend.
  std::vector<std::int64_t> ids = tree.sphere_ids;
  for (const Node& node : tree.nodes)
    if (node.is_leaf()) std::sort(ids.begin() + node.first, ids.begin() + node.first + node.sphere_count);
  for (std::int64_t i = 0; i < 5000; ++i) {
    const PackedSphere packed = unpack_sphere(textures, i);
    const std::int64_t id = ids[static_cast<std::size_t>(i)];
    ASSERT_EQ(packed.id, id);
    ASSERT_EQ((Vec3d{double(packed.x), double(packed.y), double(packed.z)}), scene.spheres.stored_centre(id));
    ASSERT_EQ(double(packed.r), scene.spheres.stored_radius(id));
    const Material wanted = material_of(scene, id), got = unpack_look(textures, packed.look);
    ASSERT_EQ(to_float(got.colour), to_float(wanted.colour));
    ASSERT_EQ(float(got.ambient), float(wanted.ambient));
    ASSERT_EQ(float(got.diffuse), float(wanted.diffuse));
    ASSERT_EQ(float(got.reflective), float(wanted.reflective));
    ASSERT_EQ(float(got.specular), float(wanted.specular));
    ASSERT_EQ(float(got.power), float(wanted.power));
    ASSERT_EQ(float(got.transmissive), float(wanted.transmissive));
    ASSERT_EQ(float(got.refraction_index), float(wanted.refraction_index));
  }
}

TEST(TreeTextures, without_a_tree_spheres_are_in_the_order_of_ids) {
  const Scene scene = scene_of(100);
  const SceneTextures textures = pack_scene(scene, nullptr, 2048).value();
  EXPECT_EQ(textures.node_count, 0);
  EXPECT_EQ(textures.nodes.height(), 1);
  for (std::int64_t i = 0; i < 100; ++i) EXPECT_EQ(unpack_sphere(textures, i).id, i);
}

TEST(TreeTextures, hold_every_node) {
  const Scene scene = scene_of(3000);
  const Tree tree = build_reference_tree(scene.spheres, {2, kUnlimited});
  const SceneTextures textures = pack_scene(scene, &tree, 2048).value();
  ASSERT_EQ(textures.node_count, static_cast<std::int64_t>(tree.nodes.size()));
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const Node& wanted = tree.nodes[i];
    const Node got = unpack_node(textures, static_cast<std::int64_t>(i));
    ASSERT_EQ(got.left_clip, wanted.left_clip);
    ASSERT_EQ(got.right_clip, wanted.right_clip);
    ASSERT_EQ(got.kind, wanted.kind);
    ASSERT_EQ(got.split_axis, wanted.split_axis);
    ASSERT_EQ(got.first, wanted.first);
    ASSERT_EQ(got.sphere_count, wanted.sphere_count);
  }
}

TEST(TreeTextures, know_how_many_nodes_may_wait) {
  // A root with two leaves; one leaf alone.
  Scene scene;
  scene.spheres = SphereSet::from_world(std::vector<double>{-1, 1}, {0, 0}, {0, 0}, {0.5, 0.5}).value();
  const Tree two = build_reference_tree(scene.spheres, {1, kUnlimited});
  EXPECT_EQ(pack_scene(scene, &two, 2048)->most_waiting, 1);
  const Tree one = build_reference_tree(scene.spheres, {8, kUnlimited});
  EXPECT_EQ(pack_scene(scene, &one, 2048)->most_waiting, 0);
}

TEST(TreeTextures, merge_equal_looks) {
  const Scene scene = scene_of(1000);
  EXPECT_EQ(pack_scene(scene, nullptr, 2048)->look_count, 3);  // the plane's, red, transparent
}

TEST(TreeTextures, opacity_is_folded_into_looks) {
  Scene scene = scene_of(2);
  scene.spheres.attributes().opacity = {1.0F, 0.25F};
  const SceneTextures textures = pack_scene(scene, nullptr, 2048).value();
  EXPECT_EQ(unpack_look(textures, unpack_sphere(textures, 1).look).transmissive, 0.75);
  EXPECT_EQ(unpack_look(textures, unpack_sphere(textures, 1).look).refraction_index, 1);
}

TEST(TreeTextures, hold_what_layers_and_lines_need) {
  Scene scene;
  scene.spheres = SphereSet::from_world(std::vector<double>{0, 3, 6}, {0, 0, 0}, {0, 0, 0}, {1, 1, 1}).value();
  scene.materials = {matte_material(), transparent_material()};
  scene.material_of_sphere = {0, 0, 1};
  scene.spheres.attributes().opacity = {1.0F, 0.25F, 1.0F};
  scene.spheres.attributes().crease = {7, 7, 9};
  scene.spheres.attributes().outline_px = {-1, 2.5F, 0};
  scene.id_in_input = {10, 20, 30};
  const SceneTextures textures = pack_scene(scene, nullptr, 2048).value();
  // Straight through 0.75 of the light, for rays that see and that ask for light; glass bends rays that see.
  const double glass = transparent_material().transmissive;
  ASSERT_NE(transparent_material().refraction_index, 1);
  const std::vector<double> to_eye{0, 0.75, 0}, to_light{0, 0.75, glass};
  for (std::int64_t i = 0; i < 3; ++i) {
    const PackedSphere sphere = unpack_sphere(textures, i);
    const float* const look = &textures.looks.channels[std::size_t(16) * sphere.look];
    const auto k = static_cast<std::size_t>(i);
    EXPECT_EQ(look[13], float(to_eye[k]));
    EXPECT_EQ(look[14], float(to_light[k]));
    EXPECT_EQ(sphere.id, 10 * (i + 1)) << "hidden spheres count";
    EXPECT_EQ(sphere.group, scene.spheres.attributes().crease[k]);
    EXPECT_EQ(sphere.outline_px, scene.spheres.attributes().outline_px[k]);
  }
}

TEST(TreeTextures, lights_are_in_stored_units) {
  Scene scene = scene_of(10);
  scene.lights = {{{1, 2, -3}, {0.5, 0.25, 1}, 4}, {{1e300, 0, 0}, {1, 1, 1}, 1e299}};
  const SceneTextures textures = pack_scene(scene, nullptr, 2048).value();
  const double scale = scene.spheres.scale();
  const std::vector<float>& numbers = textures.lights.channels;
  EXPECT_EQ(textures.light_count, 2);
  EXPECT_EQ(numbers[1], static_cast<float>(2 * scale));
  EXPECT_EQ(numbers[2], static_cast<float>(-3 * scale));
  EXPECT_EQ(numbers[3], static_cast<float>(4 * scale));
  EXPECT_EQ(numbers[5], 0.25F);
  EXPECT_FLOAT_EQ(numbers[8], 1e15F);  // too far away for binary32's squares: brought nearer
  EXPECT_FLOAT_EQ(numbers[11], 1e14F);
}

TEST(TreeTextures, too_many_of_anything_is_an_error) {
  Scene scene = scene_of(5000);
  const Result<SceneTextures> spheres = pack_scene(scene, nullptr, 2);
  ASSERT_FALSE(spheres.ok());
  EXPECT_EQ(spheres.error().message, "5000 spheres are too many for this graphics processor, whose textures hold 4096");

  const Tree tree = build_reference_tree(scene.spheres, {1, kUnlimited});
  const Result<SceneTextures> nodes = pack_scene(scene, &tree, 3);
  ASSERT_FALSE(nodes.ok());
  EXPECT_NE(nodes.error().message.find(" nodes are too many"), std::string::npos) << nodes.error().message;

  for (int i = 0; i < 5000; ++i) scene.spheres.attributes().colour.push_back({float(i) / 5000, 0, 0});
  const Result<SceneTextures> looks = pack_scene(scene, nullptr, 3);
  ASSERT_FALSE(looks.ok());
  EXPECT_NE(looks.error().message.find(" different looks are too many"), std::string::npos) << looks.error().message;
}

}  // namespace
}  // namespace bihive
