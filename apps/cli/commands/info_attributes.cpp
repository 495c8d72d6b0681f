// bihive info --attributes: the attributes of spheres, for selections and colours.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bihive/job/messages.h"
#include "commands/commands.h"

namespace bihive::cli {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kMostTextsShown = 12;

// One attribute: a range of numbers, or distinct texts.
struct AttributeFacts {
  std::string name;
  std::string kind;  // "number", "whole number", "text", "element"
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();
  std::int64_t unknown = 0;  // NaN
  std::vector<std::string> texts;

  void add_number(double value) {
    if (std::isnan(value)) {
      ++unknown;
      return;
    }
    least = std::min(least, value);
    most = std::max(most, value);
  }
  bool is_text() const { return kind == "text"; }
  bool has_range() const { return least <= most; }
};

template <class T>
void add_numbers(std::vector<AttributeFacts>& facts, const std::string& name, const std::string& kind,
                 const std::vector<T>& values) {
  if (values.empty()) return;
  AttributeFacts one;
  one.name = name;
  one.kind = kind;
  for (const T value : values) one.add_number(static_cast<double>(value));
  facts.push_back(one);
}

std::vector<AttributeFacts> facts_of(const SphereSet& spheres) {
  const SphereAttributes& attributes = spheres.attributes();
  std::vector<AttributeFacts> facts;
  add_numbers(facts, "element", "element", attributes.element);
  add_numbers(facts, "type", "whole number", attributes.type);
  if (!attributes.colour.empty()) {
    AttributeFacts colour;
    colour.name = "colour";
    colour.kind = "linear red, green, blue";
    for (const Vec3f& rgb : attributes.colour)
      for (int channel = 0; channel < 3; ++channel) colour.add_number(double(rgb[channel]));
    facts.push_back(colour);
  }
  add_numbers(facts, "opacity", "number", attributes.opacity);
  for (const NamedNumbers& column : attributes.numbers) add_numbers(facts, column.name, "number", column.values);
  // Selections and colours know the length of the velocity where no column has its name.
  const NamedNumbers *const vx = attributes.find_numbers("vx"), *const vy = attributes.find_numbers("vy"),
                            *const vz = attributes.find_numbers("vz");
  if (vx != nullptr && vy != nullptr && vz != nullptr && attributes.find_numbers("speed") == nullptr) {
    std::vector<double> speed;
    for (std::size_t i = 0; i < vx->values.size(); ++i)
      speed.push_back(length(Vec3d{vx->values[i], vy->values[i], vz->values[i]}));
    add_numbers(facts, "speed", "number", speed);
  }
  for (const NamedTexts& column : attributes.texts) {
    AttributeFacts one;
    one.name = column.name;
    one.kind = "text";
    // A text whose spheres were all left out (alternate locations) no longer counts.
    std::vector<std::uint8_t> used(column.texts.size(), 0);
    for (const std::int32_t text : column.text_of_sphere) used[static_cast<std::size_t>(text)] = 1;
    for (std::size_t i = 0; i < used.size(); ++i)
      if (used[i] != 0) one.texts.push_back(column.texts[i]);
    facts.push_back(one);
  }
  return facts;
}

void print_attributes_json(const Input& input, const std::vector<AttributeFacts>& facts) {
  ordered_json json = ordered_json::object();
  json["name"] = input.scene.name;
  json["spheres"] = input.scene.spheres.size();
  json["attributes"] = ordered_json::array();
  for (const AttributeFacts& one : facts) {
    ordered_json object{{"name", one.name}, {"kind", one.kind}};
    if (one.is_text()) {
      object["distinct"] = one.texts.size();
      object["first"] = ordered_json::array();
      for (std::size_t i = 0; i < std::min(kMostTextsShown, one.texts.size()); ++i)
        object["first"].push_back(one.texts[i]);
    } else {
      object["min"] = one.has_range() ? ordered_json(one.least) : ordered_json();
      object["max"] = one.has_range() ? ordered_json(one.most) : ordered_json();
      object["nan"] = one.unknown;
    }
    json["attributes"].push_back(object);
  }
  print(json.dump(2, ' ', true, ordered_json::error_handler_t::replace) + "\n");
}

void print_attributes_text(const Input& input, const std::vector<AttributeFacts>& facts) {
  print(fmt::format("{}: {} spheres, {} attributes\n", escaped(input.scene.name), grouped(input.scene.spheres.size()),
                    facts.size()));
  for (const AttributeFacts& one : facts) {
    std::string values;
    if (one.is_text()) {
      values = fmt::format("{} distinct:", one.texts.size());
      for (std::size_t i = 0; i < std::min(kMostTextsShown, one.texts.size()); ++i)
        values += " " + (one.texts[i].empty() ? std::string("\"\"") : one.texts[i]);
      if (one.texts.size() > kMostTextsShown) values += " ...";
    } else {
      // Adding 0 makes 0 of -0.
      values = one.has_range() ? range_text(one.least + 0, one.most + 0) : "unknown";
      if (one.unknown > 0) values += fmt::format(", {} NaN", grouped(one.unknown));
    }
    print(fmt::format("  {:<18}{:<26}{}\n", escaped(one.name), one.kind, escaped(values)));
  }
}

}  // namespace

void print_attributes(const Input& input, bool as_json) {
  const std::vector<AttributeFacts> facts = facts_of(input.scene.spheres);
  (as_json ? print_attributes_json : print_attributes_text)(input, facts);
}

}  // namespace bihive::cli
