// The names by which selections and colours ask for what is known of spheres.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bihive/geometry/sphere_set.h"

namespace bihive {

struct ResolvedTerm;

/// What a name stands for in one set: numbers, texts, both (a type with labels), or nothing.
struct FoundAttribute {
  enum class Number { none, x, y, z, radius, index, element, type, opacity, column, speed, expression };
  Number number = Number::none;
  const NamedNumbers* column = nullptr;                ///< of speed: vx
  const NamedNumbers* others[2] = {nullptr, nullptr};  ///< of speed: vy and vz
  const NamedTexts* texts = nullptr;

  std::shared_ptr<const ResolvedTerm> term = {};  ///< of an expression (number_term.h)

  bool found() const { return has_numbers() || texts != nullptr; }
  bool has_numbers() const { return number != Number::none; }
  bool is_element() const { return number == Number::element; }

  /// Whether an image has another number than its stored sphere.
  bool differs_by_image() const;
  /// The number of one sphere or image; NaN: unknown. Lengths are in world units. Needs has_numbers().
  double number_of(const SphereSet& spheres, std::int64_t id) const;
};

/// x, y, z, r (or radius), index, element, type, opacity, the columns of the input, and speed where it has vx, vy and
/// vz. A column's name is tried as it is, then without regard to case, then as another program's name (beta for
/// b_factor). The set must outlive the answer.
FoundAttribute find_attribute(const SphereSet& spheres, std::string_view name);

/// Every name that find_attribute() knows in this set, without those of other programs.
std::vector<std::string> attribute_names(const SphereSet& spheres);

/// "x, y, z ...": at most 20 of them.
std::string list_of_names(const std::vector<std::string>& names);

/// For messages: what there is, with the nearest name first, if one is near.
std::string suggestion(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace bihive
