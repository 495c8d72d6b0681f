#include "bihive/gl/tree_textures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>
#include <string>
#include <unordered_map>
#include <utility>

namespace bihive {
namespace {

constexpr int kTexelsOfLook = 4;
constexpr std::int64_t kMostSpheresOfLeaf = (std::int64_t{1} << 27) - 1;

// Lights farther away shine from the same direction, but the squares of their distances would leave binary32.
constexpr double kFarthestLight = 1e15;

using LookTexels = std::array<float, std::size_t{4} * kTexelsOfLook>;

struct HashOfLook {
  std::size_t operator()(const LookTexels& look) const {
    std::uint64_t hash = 14695981039346656037u;
    for (const float value : look) {
      std::uint32_t bits = 0;
      std::memcpy(&bits, &value, sizeof(bits));
      hash = (hash ^ bits) * 1099511628211u;
    }
    return static_cast<std::size_t>(hash);
  }
};

std::uint32_t bits_of(float value) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  return bits;
}

float float_of(std::uint32_t bits) {
  float value = 0;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

LookTexels look_of(const Material& m) {
  // Adding 0 makes looks with -0 and 0 equal.
  const auto number = [](double value) { return static_cast<float>(value) + 0.0F; };
  return {number(m.colour.x),
          number(m.colour.y),
          number(m.colour.z),
          number(m.ambient),
          number(m.diffuse),
          number(m.reflective),
          number(m.specular),
          number(m.power),
          number(m.transmissive),
          number(m.refraction_index),
          number(m.tint),
          number(m.glow),
          number(m.bands),
          is_passed_straight(m) ? number(std::min(m.transmissive, 1.0)) : 0,
          number(std::min(m.transmissive, 1.0)),
          0};
}

template <class T, int kChannels>
void reserve(Texels<T, kChannels>& texels, std::int64_t count) {
  const std::int64_t rows = std::max<std::int64_t>(1, (count + kTextureWidth - 1) / kTextureWidth);
  texels.channels.assign(static_cast<std::size_t>(rows * kTextureWidth * kChannels), T{});
}

Error too_many(const std::string& what, std::int64_t count, std::int64_t most) {
  return {std::to_string(count) + " " + what + " are too many for this graphics processor, whose textures hold " +
              std::to_string(most),
          "", 0, 0, "choose an engine of the CPU"};
}

// The ids in leaf order, ascending within each leaf.
std::vector<std::int64_t> leaf_order(const SphereSet& spheres, const Tree* tree) {
  std::vector<std::int64_t> ids(static_cast<std::size_t>(spheres.size()));
  std::iota(ids.begin(), ids.end(), 0);
  if (tree == nullptr) return ids;
  ids = tree->sphere_ids;
  for (const Node& node : tree->nodes)
    if (node.is_leaf()) std::sort(ids.begin() + node.first, ids.begin() + node.first + node.sphere_count);
  return ids;
}

Status pack_spheres(const Scene& scene, const Tree* tree, std::int64_t most_texels, SceneTextures& packed) {
  const SphereSet& spheres = scene.spheres;
  packed.sphere_count = spheres.size();
  if (packed.sphere_count > most_texels) return too_many("spheres", packed.sphere_count, most_texels);
  reserve(packed.spheres, packed.sphere_count);
  reserve(packed.sphere_info, packed.sphere_count);

  const std::vector<std::int64_t> ids = leaf_order(spheres, tree);
  const SphereAttributes& attributes = spheres.attributes();

  // Equal looks share one entry; the first entry belongs to the plane alone.
  std::unordered_map<LookTexels, std::uint32_t, HashOfLook> numbers;
  std::vector<LookTexels> looks{look_of(scene.plane ? scene.plane->material : Material{})};
  for (std::int64_t position = 0; position < packed.sphere_count; ++position) {
    const std::int64_t id = ids[static_cast<std::size_t>(position)];
    const auto i = static_cast<std::size_t>(id);
    const LookTexels look = look_of(material_of(scene, id));
    const auto [entry, is_new] = numbers.try_emplace(look, static_cast<std::uint32_t>(looks.size()));
    if (is_new) looks.push_back(look);

    const std::array<float, 4> sphere{spheres.x()[i], spheres.y()[i], spheres.z()[i], spheres.r()[i]};
    std::copy(sphere.begin(), sphere.end(), packed.spheres.channels.begin() + 4 * position);
    const std::array<std::uint32_t, 4> info{
        static_cast<std::uint32_t>(input_id(scene, id)), entry->second,
        attributes.crease.empty() ? 0 : static_cast<std::uint32_t>(attributes.crease[i]),
        bits_of(attributes.outline_px.empty() ? -1 : attributes.outline_px[i])};
    std::copy(info.begin(), info.end(), packed.sphere_info.channels.begin() + 4 * position);
  }

  packed.look_count = static_cast<std::int64_t>(looks.size());
  if (packed.look_count * kTexelsOfLook > most_texels)
    return too_many("different looks", packed.look_count, most_texels / kTexelsOfLook);
  reserve(packed.looks, packed.look_count * kTexelsOfLook);
  for (std::size_t i = 0; i < looks.size(); ++i)
    std::copy(looks[i].begin(), looks[i].end(), packed.looks.channels.begin() + std::ptrdiff_t(4 * kTexelsOfLook * i));
  return Done{};
}

Status pack_tree(const Tree& tree, std::int64_t most_texels, SceneTextures& packed) {
  packed.node_count = static_cast<std::int64_t>(tree.nodes.size());
  if (2 * packed.node_count > most_texels) return too_many("nodes", packed.node_count, most_texels / 2);
  reserve(packed.nodes, 2 * packed.node_count);
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const Node& node = tree.nodes[i];
    if (node.sphere_count > kMostSpheresOfLeaf)
      return too_many("spheres of one leaf", node.sphere_count, kMostSpheresOfLeaf);
    std::uint32_t* const out = &packed.nodes.channels[4 * i];
    out[0] = bits_of(node.left_clip);
    out[1] = bits_of(node.right_clip);
    out[2] = static_cast<std::uint32_t>(node.kind) | std::uint32_t{node.split_axis} << 3 |
             static_cast<std::uint32_t>(node.sphere_count) << 5;
    out[3] = static_cast<std::uint32_t>(node.first);
  }

  // Descend every path and count its nodes with two children.
  std::vector<std::pair<std::int64_t, int>> open{{0, 0}};
  while (!open.empty()) {
    const auto [position, above] = open.back();
    open.pop_back();
    packed.most_waiting = std::max(packed.most_waiting, above);
    const Node& node = tree.nodes[static_cast<std::size_t>(position)];
    if (node.is_leaf()) continue;
    const bool split = node.kind == NodeKind::split;
    open.emplace_back(node.left_child(), above + (split ? 1 : 0));
    if (split) open.emplace_back(node.right_child(), above + 1);
  }
  return Done{};
}

Status pack_lights(const Scene& scene, std::int64_t most_texels, SceneTextures& packed) {
  packed.light_count = static_cast<std::int64_t>(scene.lights.size());
  if (2 * packed.light_count > most_texels) return too_many("lights", packed.light_count, most_texels / 2);
  reserve(packed.lights, 2 * packed.light_count);
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const PointLight& light = scene.lights[i];
    Vec3d position = scene.spheres.to_local(light.position) * scene.spheres.scale();
    double radius = light.radius * scene.spheres.scale();
    const double farthest = std::max({std::abs(position.x), std::abs(position.y), std::abs(position.z)});
    if (farthest > kFarthestLight) {
      position = (position / farthest) * kFarthestLight;
      radius = (radius / farthest) * kFarthestLight;
    }
    const std::array<float, 8> out{float(position.x),     float(position.y),     float(position.z),     float(radius),
                                   float(light.colour.x), float(light.colour.y), float(light.colour.z), 0};
    std::copy(out.begin(), out.end(), packed.lights.channels.begin() + std::ptrdiff_t(8 * i));
  }
  return Done{};
}

}  // namespace

Result<SceneTextures> pack_scene(const Scene& scene, const Tree* tree, int most_rows) {
  const std::int64_t most_texels = std::int64_t{most_rows} * kTextureWidth;
  SceneTextures packed;
  if (const Status status = pack_spheres(scene, tree, most_texels, packed); !status) return status.error();
  reserve(packed.nodes, 0);
  if (tree != nullptr)
    if (const Status status = pack_tree(*tree, most_texels, packed); !status) return status.error();
  if (const Status status = pack_lights(scene, most_texels, packed); !status) return status.error();
  return packed;
}

Result<SceneTextures> pack_lights(const Scene& scene, int most_rows) {
  SceneTextures packed;
  if (const Status status = pack_lights(scene, std::int64_t{most_rows} * kTextureWidth, packed); !status)
    return status.error();
  return packed;
}

PackedSphere unpack_sphere(const SceneTextures& textures, std::int64_t position) {
  const float* const sphere = &textures.spheres.channels[static_cast<std::size_t>(4 * position)];
  const std::uint32_t* const info = &textures.sphere_info.channels[static_cast<std::size_t>(4 * position)];
  return {sphere[0],        sphere[1], sphere[2], sphere[3], info[0], info[1], static_cast<std::int32_t>(info[2]),
          float_of(info[3])};
}

Node unpack_node(const SceneTextures& textures, std::int64_t position) {
  const std::uint32_t* const in = &textures.nodes.channels[static_cast<std::size_t>(4 * position)];
  Node node;
  node.left_clip = float_of(in[0]);
  node.right_clip = float_of(in[1]);
  node.kind = static_cast<NodeKind>(in[2] & 7u);
  node.split_axis = static_cast<std::uint8_t>(in[2] >> 3 & 3u);
  node.sphere_count = in[2] >> 5;
  node.first = in[3];
  return node;
}

Material unpack_look(const SceneTextures& textures, std::int64_t look) {
  const float* const in = &textures.looks.channels[static_cast<std::size_t>(4 * kTexelsOfLook * look)];
  Material material;
  material.colour = {double(in[0]), double(in[1]), double(in[2])};
  material.ambient = double(in[3]);
  material.diffuse = double(in[4]);
  material.reflective = double(in[5]);
  material.specular = double(in[6]);
  material.power = double(in[7]);
  material.transmissive = double(in[8]);
  material.refraction_index = double(in[9]);
  material.tint = double(in[10]);
  material.glow = double(in[11]);
  material.bands = static_cast<int>(in[12]);
  return material;
}

}  // namespace bihive
