#include "bihive/scene/legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "bihive/io/elements.h"
#include "bihive/scene/palette.h"
#include "bihive/select/attribute_names.h"
#include "bihive/select/number_term.h"

namespace bihive {
namespace {

// The names of an attribute's categories, as colour_by() tells them apart.
class CategoryNames {
 public:
  CategoryNames(const SphereSet& spheres, const FoundAttribute& attribute) : spheres_(spheres), attribute_(attribute) {}

  // Ascends in the order of the legend; NaN: unknown.
  double place(std::int64_t id) const {
    if (attribute_.is_element()) {
      const double number = attribute_.number_of(spheres_, id);
      return number > 0 ? number : std::nan("");
    }
    return attribute_.has_numbers() ? std::floor(attribute_.number_of(spheres_, id)) : text_of(id);
  }
  std::string name(std::int64_t id) const {
    const double number = place(id);
    if (std::isnan(number)) return "unknown";
    if (attribute_.is_element()) return element_symbol(static_cast<int>(number));
    if (attribute_.texts == nullptr) return fmt::format("{}", number);
    const std::string& text = attribute_.texts->of(static_cast<std::size_t>(id));
    return text.empty() ? "(none)" : text;
  }

 private:
  double text_of(std::int64_t id) const { return attribute_.texts->text_of_sphere[static_cast<std::size_t>(id)]; }

  const SphereSet& spheres_;
  FoundAttribute attribute_;
};

FoundAttribute attribute_of(const SphereSet& spheres, const ColourBy& how) {
  const Result<FoundAttribute> found = find_numbers(spheres, how.attribute);
  return found ? *found : FoundAttribute();
}

// Types in a row that differ in colour.
std::size_t type_colour_count() {
  static const std::size_t count = [] {
    std::int32_t types = 1;
    while (!(type_colour(1 + types) == type_colour(1))) ++types;
    return static_cast<std::size_t>(types);
  }();
  return count;
}

// Whether there may be more categories than colours: a bound that costs at most a pass over numbers.
bool may_share_colours(const SphereSet& spheres, const ColourBy& how) {
  const FoundAttribute attribute = attribute_of(spheres, how);
  if (how.range || !attribute.found() || attribute.is_element()) return false;
  if (!attribute.has_numbers()) return attribute.texts->texts.size() > type_colour_count();
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::int64_t id = 0; id < spheres.size(); ++id) {
    const double number = attribute.number_of(spheres, id);
    low = std::min(low, number);
    high = std::max(high, number);
  }
  return std::floor(high) - std::floor(low) >= static_cast<double>(type_colour_count());
}

// Collects the spheres of one key.
class KeyCollector {
 public:
  KeyCollector(const Scene& scene, const ColourBy& how)
      : scene_(scene), how_(how), attribute_(attribute_of(scene.spheres, how)), names_(scene.spheres, attribute_) {}

  void add(std::int64_t id) { add(id, scene_.spheres.attributes().colour[static_cast<std::size_t>(id)]); }
  void add(std::int64_t id, Vec3f colour) {
    if (!attribute_.found()) return;
    if (!used_) spheres_.push_back(id);
    used_ = true;
    double place = 0;
    bool below_logarithms = false;
    if (how_.range) {
      const double number = attribute_.number_of(scene_.spheres, id);
      place = place_in_range(*how_.range, how_.logarithmic, number);
      below_logarithms = how_.logarithmic && number <= 0;
      if (!std::isnan(place) && !is_known_) spheres_.push_back(id);
      is_known_ = is_known_ || !std::isnan(place);
      if (!std::isnan(place) && !below_logarithms) return;
    } else {
      place = names_.place(id);
    }
    // NaN has no order.
    const auto [position, is_new] = entries_.try_emplace({std::isnan(place), std::isnan(place) ? 0 : place});
    if (!is_new) return;
    spheres_.push_back(id);
    position->second = {below_logarithms ? "0 or less"
                        : how_.range     ? "unknown"
                                         : names_.name(id),
                        screen_colour(to_double(colour), scene_.picture.transfer)};
  }

  bool used() const { return used_; }

  // Takes the entries of a key that says the same: of one attribute, by category, without a category that has another
  // colour there.
  bool join(const KeyCollector& other) {
    if (how_.range || other.how_.range || how_.attribute != other.how_.attribute || how_.title != other.how_.title)
      return false;
    for (const auto& [place, entry] : other.entries_)
      if (const auto own = entries_.find(place); own != entries_.end() && own->second.colour != entry.colour)
        return false;
    entries_.insert(other.entries_.begin(), other.entries_.end());
    return true;
  }

  bool knows_nothing() const { return how_.range && !is_known_; }
  const std::string& attribute() const { return how_.attribute; }
  /// The first one, and of each entry the first.
  const std::vector<std::int64_t>& spheres() const { return spheres_; }
  LegendKey key() const {
    LegendKey key;
    key.title = how_.title.empty() ? how_.attribute : how_.title;
    if (how_.range && is_known_) key.scale = {how_.map.value_or(ColourMap()), *how_.range, how_.logarithmic};
    for (const auto& [place, entry] : entries_) key.entries.push_back(entry);
    return key;
  }

 private:
  const Scene& scene_;
  const ColourBy& how_;
  FoundAttribute attribute_;
  CategoryNames names_;
  bool used_ = false;
  bool is_known_ = false;                                   // some number of a range
  std::map<std::pair<bool, double>, LegendEntry> entries_;  // the unknown one last
  std::vector<std::int64_t> spheres_;
};

// The collectors of all keys, with all spheres.
std::vector<KeyCollector> collected(const Scene& scene) {
  std::vector<KeyCollector> collectors;
  if (scene.coloured_by.empty() || scene.spheres.attributes().colour.empty()) return collectors;
  collectors.reserve(scene.coloured_by.size());
  for (const ColourBy& how : scene.coloured_by) collectors.emplace_back(scene, how);
  for (std::int64_t id = 0; id < scene.spheres.size(); ++id) {
    const std::int32_t key =
        scene.coloured_by_of_sphere.empty() ? 0 : scene.coloured_by_of_sphere[static_cast<std::size_t>(id)];
    if (key >= 0) collectors[static_cast<std::size_t>(key)].add(id);
  }
  return collectors;
}

// The first sphere of each name, -1: it has none.
std::vector<std::int64_t> spheres_of_names(const Scene& scene) {
  std::vector<std::int64_t> first(scene.legend_names.size(), -1);
  if (first.empty()) return first;
  for (std::size_t id = 0; id < scene.coloured_by_of_sphere.size(); ++id) {
    const std::int32_t meaning = scene.coloured_by_of_sphere[id];
    if (meaning > -2) continue;
    std::int64_t& of_name = first[static_cast<std::size_t>(-2 - meaning)];
    if (of_name < 0) of_name = static_cast<std::int64_t>(id);
  }
  return first;
}

// The named selections. One name with one colour stands once.
LegendKey key_of_names(const Scene& scene) {
  LegendKey key;
  const std::vector<std::int64_t> spheres = spheres_of_names(scene);
  for (std::size_t name = 0; name < spheres.size(); ++name) {
    if (spheres[name] < 0) continue;
    const Vec3f colour = scene.spheres.attributes().colour[static_cast<std::size_t>(spheres[name])];
    const LegendEntry entry{scene.legend_names[name], screen_colour(to_double(colour), scene.picture.transfer)};
    const bool is_new = std::none_of(key.entries.begin(), key.entries.end(), [&entry](const LegendEntry& other) {
      return other.name == entry.name && other.colour == entry.colour;
    });
    if (is_new) key.entries.push_back(entry);
  }
  return key;
}

// The categories of spheres whose arrows have the colours of these.
std::optional<LegendKey> categories_of_sticks(const Scene& scene, const ColourBy& how,
                                              const std::vector<LegendKey>& keys) {
  const SphereSet& spheres = scene.spheres;
  std::vector<Vec3f> colours(static_cast<std::size_t>(spheres.size()));
  const std::vector<std::uint8_t> all(colours.size(), 1);
  if (!colour_by(spheres, how, all, scene.picture.transfer, colours, scene.element_colours)) return std::nullopt;
  KeyCollector collector(scene, how);
  for (auto stick = static_cast<std::int64_t>(scene.sticks.pairs().size()); stick < scene.sticks.size(); ++stick) {
    const std::int64_t sphere = scene.sticks.sphere_at(spheres, 2 * stick);
    const Vec3f* const colour = scene.sticks.colour_at(2 * stick);
    if (colour != nullptr && *colour == colours[static_cast<std::size_t>(sphere)]) collector.add(sphere, *colour);
  }
  if (!collector.used()) return std::nullopt;
  LegendKey key = collector.key();
  const auto is_in = [](const LegendEntry& one, const LegendKey& other) {
    return std::any_of(other.entries.begin(), other.entries.end(),
                       [&](const LegendEntry& entry) { return entry.name == one.name && entry.colour == one.colour; });
  };
  const bool is_said = std::any_of(keys.begin(), keys.end(), [&](const LegendKey& other) {
    return other.title == key.title && std::all_of(key.entries.begin(), key.entries.end(),
                                                   [&](const LegendEntry& one) { return is_in(one, other); });
  });
  return is_said ? std::nullopt : std::optional(std::move(key));
}

// The map or the categories of arrows or links, unless spheres have said them. Links have no categories.
std::optional<LegendKey> key_of_sticks(const Scene& scene, const ColourBy& how, const std::vector<LegendKey>& keys) {
  if (!how.range) return categories_of_sticks(scene, how, keys);
  LegendKey key;
  key.title = how.title.empty() ? how.attribute : how.title;
  key.scale = {how.map.value_or(ColourMap()), *how.range, how.logarithmic};
  const bool is_said = std::any_of(keys.begin(), keys.end(), [&](const LegendKey& other) {
    return other.title == key.title && other.scale && other.scale->map == key.scale->map &&
           other.scale->range == key.scale->range && other.scale->logarithmic == key.scale->logarithmic;
  });
  return is_said ? std::nullopt : std::optional(std::move(key));
}

}  // namespace

std::vector<LegendKey> legend_of(const Scene& scene) {
  std::vector<KeyCollector> joined;
  for (const KeyCollector& collector : collected(scene)) {
    if (!collector.used()) continue;
    const bool is_said =
        std::any_of(joined.begin(), joined.end(), [&](KeyCollector& earlier) { return earlier.join(collector); });
    if (!is_said) joined.push_back(collector);
  }
  std::vector<LegendKey> keys;
  for (const KeyCollector& collector : joined) keys.push_back(collector.key());
  if (LegendKey names = key_of_names(scene); !names.entries.empty()) keys.push_back(std::move(names));
  for (const ColourBy& how : scene.sticks_coloured_by)
    if (std::optional<LegendKey> of_sticks = key_of_sticks(scene, how, keys)) keys.push_back(std::move(*of_sticks));
  return keys;
}

std::vector<LegendKey> legend_of(const Scene& scene, const Labels& labels) {
  std::vector<LegendKey> keys = legend_of(scene);
  if (labels.legend_title.empty()) return keys;
  const auto titled = std::find_if(keys.rbegin(), keys.rend(), [](const LegendKey& key) { return !key.title.empty(); });
  if (titled != keys.rend())
    titled->title = labels.legend_title;
  else if (!keys.empty())
    keys.back().title = labels.legend_title;
  return keys;
}

std::vector<std::int64_t> spheres_of_legend(const Scene& scene) {
  std::vector<std::int64_t> ids;
  for (const KeyCollector& collector : collected(scene))
    ids.insert(ids.end(), collector.spheres().begin(), collector.spheres().end());
  for (const std::int64_t id : spheres_of_names(scene))
    if (id >= 0) ids.push_back(id);
  return ids;
}

std::string unknown_numbers(const Scene& scene) {
  for (const KeyCollector& collector : collected(scene))
    if (collector.used() && collector.knows_nothing())
      return "no sphere has a number of " + collector.attribute() + ": all have the colour of unknown numbers";
  return "";
}

std::string shared_colours(const Scene& scene) {
  if (std::none_of(scene.coloured_by.begin(), scene.coloured_by.end(),
                   [&](const ColourBy& how) { return may_share_colours(scene.spheres, how); }))
    return "";
  constexpr std::size_t kMostNamed = 3;
  for (const LegendKey& key : legend_of(scene)) {
    if (key.scale || key.title == "element") continue;
    std::string named;
    std::size_t shared = 0;
    for (auto entry = key.entries.begin(); entry != key.entries.end(); ++entry) {
      const auto first = std::find_if(key.entries.begin(), entry,
                                      [&](const LegendEntry& other) { return other.colour == entry->colour; });
      if (first == entry || ++shared > kMostNamed) continue;
      named += (named.empty() ? "" : ", ") + entry->name + " that of " + first->name;
    }
    if (shared > 0)
      return "there are " + std::to_string(type_colour_count()) + " colours for categories, and some of " + key.title +
             " share one: " + named +
             (shared > kMostNamed ? " and " + std::to_string(shared - kMostNamed) + " more" : "");
  }
  return "";
}

namespace {

// The eye does not tell such colours apart where they are not side by side.
constexpr double kNearly = 30.0 / 255;

double difference(Vec3d a, Vec3d b) {
  return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
}

// A sentence on two entries of different names; empty: their colours differ.
std::string equal_entries(const LegendEntry& a, const LegendEntry& b) {
  if (a.name == b.name || a.colour.x < 0 || b.colour.x < 0 || difference(a.colour, b.colour) > kNearly) return "";
  return std::string("the legend has ") + (a.colour == b.colour ? "one" : "nearly one") + " colour for " + a.name +
         " and " + b.name;
}

}  // namespace

std::string equal_colours(const Scene& scene) {
  const std::vector<LegendKey> keys = legend_of(scene);
  for (std::size_t k = 0; k < keys.size(); ++k)
    for (std::size_t other = k; other < keys.size(); ++other) {
      // shared_colours() tells of categories of one attribute.
      if (other == k && !keys[k].title.empty()) continue;
      for (const LegendEntry& entry : keys[k].entries)
        for (const LegendEntry& equal : keys[other].entries)
          if (std::string sentence = equal_entries(entry, equal); !sentence.empty()) return sentence;
    }
  return "";
}

Vec3d screen_colour(Vec3d linear, Transfer transfer) {
  for (int channel = 0; channel < 3; ++channel) {
    const double clamped = std::clamp(linear[channel], 0.0, 1.0);
    linear[channel] = transfer == Transfer::srgb ? srgb_from_linear(clamped) : clamped;
  }
  return linear;
}

}  // namespace bihive
