#include "bihive/render/layers.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "bihive/base/check.h"
#include "bihive/base/parallel.h"
#include "bihive/render/scene_hit.h"
#include "bihive/render/surface.h"
#include "bihive/scene/clips.h"
#include "bihive/select/attribute_names.h"
#include "bihive/wide/ray_batch.h"

namespace bihive {
namespace {

constexpr int kLayerTilePx = 64;

const std::vector<std::pair<std::string, LayerKind>> kLayerNames{
    {"radiance", LayerKind::radiance}, {"albedo", LayerKind::albedo}, {"depth", LayerKind::depth},
    {"normal", LayerKind::normal},     {"id", LayerKind::id},
};
const std::string kAttributePrefix = "attribute:";

Result<Layer> layer_from_word(const std::string& word) {
  std::string known;
  for (const auto& [name, kind] : kLayerNames) {
    if (name == word) return Layer{kind};
    known += name + ", ";
  }
  if (word.size() > kAttributePrefix.size() && word.compare(0, kAttributePrefix.size(), kAttributePrefix) == 0)
    return Layer{LayerKind::attribute, word.substr(kAttributePrefix.size())};
  return Error{"there is no layer \"" + word + "\"; the layers are " + known + "and attribute:NAME", "", 0, 0, ""};
}

// Sticks are numbered after the spheres of the input, hidden ones counted.
std::int64_t first_id_of_sticks(const Scene& scene) {
  return std::max(scene.size_of_input * scene.spheres.images().count(), scene.spheres.total_size());
}

// The channels that a layer has, in this order.
std::vector<std::string> channel_names(const Layer& layer) {
  switch (layer.kind) {
    case LayerKind::radiance:
      return {"R", "G", "B"};
    case LayerKind::albedo:
      return {"albedo.R", "albedo.G", "albedo.B"};
    case LayerKind::depth:
      return {"Z"};
    case LayerKind::normal:
      return {"normal.X", "normal.Y", "normal.Z"};
    case LayerKind::id:
      return {"id"};
    case LayerKind::attribute:
      break;
  }
  return {"attribute." + layer.attribute};
}

// The channels of one layer, of a first surface after the other.
class LayerWriter {
 public:
  /// `cuts`: of the scene (scene/clips.h); null: all spheres are whole.
  LayerWriter(const Scene& scene, const CutSet* cuts, const PixelRays& rays, const Layer& layer, Channel* channels)
      : scene_(scene), cuts_(cuts), rays_(rays), kind_(layer.kind), channels_(channels) {
    if (kind_ == LayerKind::attribute) attribute_ = find_attribute(scene.spheres, layer.attribute);
  }

  void put(std::size_t pixel, const Ray& ray, const SceneHit& hit) const {
    switch (kind_) {
      case LayerKind::radiance:
        return;
      case LayerKind::albedo:
        return put_vector(pixel, hit.found() ? surface_at(scene_, ray, hit, cuts_).material.colour : Vec3d{});
      case LayerKind::normal:
        return put_vector(pixel, hit.found() ? surface_at(scene_, ray, hit, cuts_).normal : Vec3d{});
      case LayerKind::depth:
        channels_->numbers[pixel] = hit.found()
                                        ? static_cast<float>(hit.t * dot(to_double(ray.direction), rays_.forward()))
                                        : std::numeric_limits<float>::infinity();
        return;
      case LayerKind::id:
        channels_->ids[pixel] = id_of(hit);
        return;
      case LayerKind::attribute:
        channels_->numbers[pixel] = static_cast<float>(number_of(hit));
    }
  }

 private:
  void put_vector(std::size_t pixel, Vec3d vector) const {
    for (int axis = 0; axis < 3; ++axis) channels_[axis].numbers[pixel] = static_cast<float>(vector[axis]);
  }

  std::uint32_t id_of(const SceneHit& hit) const {
    if (!hit.found()) return kIdOfNothing;
    if (hit.id == kPlane) return kIdOfPlane;
    const std::int64_t half = hit.id - scene_.spheres.total_size();
    return static_cast<std::uint32_t>(half < 0 ? input_id(scene_, hit.id) : first_id_of_sticks(scene_) + half / 2);
  }

  double number_of(const SceneHit& hit) const {
    if (hit.id < 0) return std::numeric_limits<double>::quiet_NaN();
    const std::int64_t sphere = shown_sphere(scene_, hit.id);
    if (attribute_.number == FoundAttribute::Number::index) return static_cast<double>(input_id(scene_, sphere));
    return attribute_.number_of(scene_.spheres, sphere);
  }

  const Scene& scene_;
  const CutSet* cuts_;
  const PixelRays& rays_;
  LayerKind kind_;
  Channel* channels_;
  FoundAttribute attribute_;
};

void put_radiance(const Film& film, std::vector<Channel>& channels, std::size_t first) {
  const bool with_coverage = !film.coverage.empty();
  for (std::size_t i = 0; i < film.radiance.size(); ++i) {
    const float share = with_coverage ? film.coverage[i] : 1;
    for (std::size_t channel = 0; channel < 3; ++channel)
      channels[first + channel].numbers[i] = film.radiance[i][static_cast<int>(channel)] * share;
    if (with_coverage) channels[first + 3].numbers[i] = share;
  }
}

}  // namespace

std::string name_of_layer(const Layer& layer) {
  for (const auto& [name, kind] : kLayerNames)
    if (kind == layer.kind) return name;
  return kAttributePrefix + layer.attribute;
}

Result<std::vector<Layer>> layers_from_text(const std::string& text) {
  std::vector<Layer> layers;
  for (std::size_t first = 0; first <= text.size();) {
    const std::size_t end = std::min(text.find(',', first), text.size());
    Result<Layer> layer = layer_from_word(text.substr(first, end - first));
    if (!layer) return layer.error();
    layers.push_back(std::move(*layer));
    first = end + 1;
  }
  return layers;
}

Status check_layers(const Scene& scene, const std::vector<Layer>& layers) {
  if (layers.empty()) return Error{"there are no layers", "", 0, 0, "name some: radiance,depth"};
  constexpr std::size_t kLongestName = 200;
  std::vector<std::string> names;
  for (const Layer& layer : layers) {
    names.push_back(name_of_layer(layer));
    if (std::count(names.begin(), names.end(), names.back()) > 1)
      return Error{"the layer " + names.back() + " stands twice", "", 0, 0, "leave one out"};
    const bool has_ids = layer.kind == LayerKind::id && scene.spheres.size() > 0;
    if (has_ids && (input_id(scene, scene.spheres.total_size() - 1) >= std::int64_t{kIdOfPlane} ||
                    first_id_of_sticks(scene) + scene.sticks.total_size(scene.spheres) > std::int64_t{kIdOfPlane}))
      return Error{"ids of this many spheres need more than 32 bits", "", 0, 0, "leave the layer id out"};
    if (layer.kind != LayerKind::attribute) continue;
    const FoundAttribute attribute = find_attribute(scene.spheres, layer.attribute);
    if (!attribute.found())
      return Error{"there is no attribute \"" + layer.attribute + "\"", "", 0, 0,
                   suggestion(layer.attribute, attribute_names(scene.spheres))};
    if (!attribute.has_numbers())
      return Error{"\"" + layer.attribute + "\" holds texts, and a layer holds numbers", "", 0, 0,
                   "take the layer id, and look the text up"};
    if (layer.attribute.size() > kLongestName)
      return Error{"the name of the attribute is too long for OpenEXR", "", 0, 0, ""};
  }
  return Done{};
}

bool has_radiance(const std::vector<Layer>& layers) {
  return std::any_of(layers.begin(), layers.end(),
                     [](const Layer& layer) { return layer.kind == LayerKind::radiance; });
}

std::vector<Channel> channels_of(const std::vector<Layer>& layers, bool with_coverage) {
  std::vector<Channel> channels;
  for (const Layer& layer : layers) {
    for (std::string& name : channel_names(layer))
      channels.push_back({std::move(name), layer.kind == LayerKind::id, {}, {}});
    if (layer.kind == LayerKind::radiance && with_coverage) channels.push_back({"A", false, {}, {}});
  }
  return channels;
}

std::vector<Channel> draw_layers(const Scene& scene, const Tracer& tracer, const RenderSettings& settings,
                                 const std::vector<Layer>& layers, const Film& film, const CancelToken* cancel) {
  const Tile drawn = drawn_pixels(settings);
  const std::size_t pixels = static_cast<std::size_t>(drawn.width()) * static_cast<std::size_t>(drawn.height());
  if (has_radiance(layers)) BIHIVE_CHECK_EQ(film.radiance.size(), pixels);
  std::vector<Channel> channels = channels_of(layers, !film.coverage.empty());
  for (Channel& channel : channels) channel.of_ids ? channel.ids.resize(pixels) : channel.numbers.resize(pixels);

  // The light is there; the others need their writers.
  const PixelRays rays(local_camera(scene), settings.width_px, settings.height_px);
  const std::shared_ptr<const CutSet> cuts = cut_set_of(scene);
  std::vector<LayerWriter> writers;
  std::size_t first = 0;
  for (const Layer& layer : layers) {
    if (layer.kind == LayerKind::radiance)
      put_radiance(film, channels, first);
    else
      writers.emplace_back(scene, cuts.get(), rays, layer, &channels[first]);
    first += channels_of({layer}, !film.coverage.empty()).size();
  }
  if (writers.empty()) return channels;

  // Find the first surface behind each pixel.
  const std::vector<Tile> tiles = tiles_of(drawn, kLayerTilePx);
  parallel_for(settings.threads, static_cast<std::int64_t>(tiles.size()), [&](std::int64_t number) {
    if (cancel != nullptr && cancel->cancelled()) return;
    const Tile& tile = tiles[static_cast<std::size_t>(number)];
    static thread_local HitBatch hits;
    hits.resize(std::int64_t{tile.width()} * tile.height());
    tracer.closest_hits(rays, tile, hits.span());
    std::int64_t next = 0;
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x) {
        const Ray ray = rays.at(x + 0.5, y + 0.5);
        SceneHit hit = scene_hit(scene, hits.at(next++), ray);
        if (hit.id == kPlane && scene.plane->shadows_only) hit = {};
        const std::size_t pixel = static_cast<std::size_t>(y - drawn.y0) * static_cast<std::size_t>(drawn.width()) +
                                  static_cast<std::size_t>(x - drawn.x0);
        for (const LayerWriter& writer : writers) writer.put(pixel, ray, hit);
      }
  });
  return channels;
}

}  // namespace bihive
