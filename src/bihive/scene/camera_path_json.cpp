// The other half of camera_path.h: key frames as JSON.

#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>

#include "bihive/scene/camera_path.h"
#include "bihive/scene/scene_json.h"

namespace bihive {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr double kMostKeyDegrees = 1e6;
constexpr double kLargestPlace = 3.4028234663852886e38;
constexpr double kMostZoom = 1e6;
constexpr std::int64_t kMostPictures = std::int64_t{1} << 40;

std::optional<Vec3d> three_numbers(const json& value, double most) {
  if (!value.is_array() || value.size() != 3) return std::nullopt;
  Vec3d numbers;
  for (int i = 0; i < 3; ++i) {
    const json& number = value[static_cast<std::size_t>(i)];
    if (!number.is_number() || !(std::abs(number.get<double>()) <= most)) return std::nullopt;
    numbers[i] = number.get<double>();
  }
  return numbers;
}

// Makes errors about one location of a document.
class Place {
 public:
  Place(std::string name, std::string pointer) : name_(std::move(name)), pointer_(std::move(pointer)) {}

  Error expected(const std::string& what, const json& found) const {
    return {pointer_ + ": expected " + what + ", found " +
                found.dump(-1, ' ', true, json::error_handler_t::replace).substr(0, 60),
            name_, 0, 0, "docs/films.md describes key frames"};
  }

 private:
  std::string name_, pointer_;
};

Result<CameraKey> key_from(const json& value, const std::string& name, const std::string& pointer) {
  const auto at = [&](const std::string& word) { return Place(name, pointer + "/" + word); };
  if (!value.is_object()) return Place(name, pointer).expected("an object", value);
  CameraKey key;
  if (!value.contains("picture")) return Place(name, pointer).expected("the word \"picture\"", value);
  for (const auto& [word, given] : value.items()) {
    if (word == "picture") {
      if (!given.is_number_integer() || given.get<double>() < 0 || given.get<double>() > double(kMostPictures))
        return at(word).expected("a whole number from 0", given);
      key.picture = given.get<std::int64_t>();
    } else if (word == "turn") {
      const std::optional<Vec3d> turn = three_numbers(given, kMostKeyDegrees);
      if (!turn) return at(word).expected("[azimuth, elevation, roll] in degrees", given);
      key.turn = Turn{turn->x, turn->y, turn->z};
    } else if (word == "zoom") {
      if (!given.is_number() || !(given.get<double>() > 0) || !(given.get<double>() <= kMostZoom))
        return at(word).expected("a number above 0", given);
      key.zoom = given.get<double>();
    } else if (word == "look_at") {
      key.look_at = three_numbers(given, kLargestPlace);
      if (!key.look_at) return at(word).expected("[x, y, z]", given);
    } else {
      return Place(name, pointer).expected("picture, turn, zoom or look_at", json(word));
    }
  }
  return key;
}

}  // namespace

Result<std::vector<CameraKey>> parse_camera_keys(std::string_view text, const std::string& name) {
  const Result<json> document = parse_json(text, name);
  if (!document) return document.error();
  const Place top(name, "/");
  if (!document->is_object() || !document->contains("keys")) return top.expected("an object with \"keys\"", *document);
  for (const auto& [word, given] : document->items())
    if (word != "keys") return top.expected("\"keys\" alone", json(word));
  const json& list = document->at("keys");
  if (!list.is_array() || list.empty()) return Place(name, "/keys").expected("a list of at least one key", list);
  std::vector<CameraKey> keys;
  keys.reserve(list.size());
  for (const json& value : list) {
    const std::string pointer = "/keys/" + std::to_string(keys.size());
    Result<CameraKey> key = key_from(value, name, pointer);
    if (!key) return key.error();
    if (!keys.empty() && key->picture <= keys.back().picture)
      return Place(name, pointer + "/picture")
          .expected("a picture after that of the previous key", value.at("picture"));
    keys.push_back(*key);
  }
  return keys;
}

std::string camera_keys_to_json(const std::vector<CameraKey>& keys) {
  ordered_json list = ordered_json::array();
  for (const CameraKey& key : keys) {
    ordered_json one = {{"picture", key.picture}};
    if (key.turn) one["turn"] = {key.turn->azimuth, key.turn->elevation, key.turn->roll};
    if (key.zoom) one["zoom"] = *key.zoom;
    if (key.look_at) one["look_at"] = {key.look_at->x, key.look_at->y, key.look_at->z};
    list.push_back(one);
  }
  return ordered_json{{"keys", list}}.dump();
}

}  // namespace bihive
