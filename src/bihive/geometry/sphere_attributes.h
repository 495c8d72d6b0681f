// Properties of spheres beyond position and radius: elements, types, colours, bonds, and the named columns of their
// file.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "bihive/math/vec3.h"

namespace bihive {

/// One number for each sphere under a name, like a column of a file (charge, velocity, temperature ...). NaN: unknown.
struct NamedNumbers {
  std::string name;
  std::vector<double> values;
};

/// One text for each sphere under a name (chain, name of the atom ...). Each distinct text is stored once in `texts`.
struct NamedTexts {
  std::string name;
  std::vector<std::string> texts;            ///< distinct, in order of appearance
  std::vector<std::int32_t> text_of_sphere;  ///< positions in `texts`

  const std::string& of(std::size_t sphere) const { return texts[static_cast<std::size_t>(text_of_sphere[sphere])]; }
};

/// Collects the texts of a column one after the other, and keeps each distinct text once.
class TextCollector {
 public:
  void reserve(std::size_t spheres) { text_of_sphere_.reserve(spheres); }
  void add(std::string_view text);
  /// Appends the texts of another collector.
  void append(const TextCollector& other);
  /// Leaves it empty, with its memory.
  void clear();

  const std::vector<std::string>& texts() const { return texts_; }
  const std::vector<std::int32_t>& text_of_sphere() const { return text_of_sphere_; }
  /// True if every collected text is empty.
  bool all_empty() const { return texts_.empty() || (texts_.size() == 1 && texts_.front().empty()); }
  /// The column; leaves the collector empty.
  NamedTexts take(std::string name);

 private:
  std::int32_t position_of(std::string_view text);

  std::vector<std::string> texts_;
  std::vector<std::int32_t> text_of_sphere_;
  std::unordered_map<std::string, std::int32_t> position_of_text_;
};

/// The order of a bond, as a file states it.
enum class BondOrder : std::uint8_t { unknown, single, double_bond, triple, aromatic };

/// Two different spheres by their ids, the smaller one first.
struct StatedBond {
  std::int32_t one = 0, other = 0;
  BondOrder order = BondOrder::unknown;

  friend bool operator==(const StatedBond& a, const StatedBond& b) {
    return a.one == b.one && a.other == b.other && a.order == b.order;
  }
};

struct StatedBonds {
  std::vector<StatedBond> list;  ///< ascending by `one`, then `other`, each pair once
  bool are_all = false;          ///< the file states some, and its format leaves none out

  bool empty() const { return list.empty(); }

  /// Appends a bond, in any order of its ends. A sphere has no bond to itself.
  void add(std::int32_t one, std::int32_t other, BondOrder order = BondOrder::unknown);
  /// Brings the list into its order after add(). Of a pair that was added several times the largest order counts.
  void put_in_order();

  /// Removes the bonds of all spheres whose mask is 0, and counts the others anew.
  void keep_only(const std::vector<std::uint8_t>& kept);
  /// The bonds between these spheres, renumbered 0, 1, 2 ... If ids repeat, the k-th occurrence of one end is bonded
  /// to the k-th of the other. O(ids + their bonds).
  StatedBonds part(const std::vector<std::int64_t>& ids) const;

  std::int64_t allocated_bytes() const { return static_cast<std::int64_t>(list.capacity() * sizeof(StatedBond)); }
};

/// The attributes of the spheres in a file. Each array is empty (not known) or has one entry for each sphere. A number
/// and a text may share a name: `type` of a file whose types are labels.
struct SphereAttributes {
  std::vector<std::uint8_t> element;  ///< atomic number; 0 = unknown
  std::vector<std::int32_t> type;     ///< the file's own particle type
  std::vector<Vec3f> colour;          ///< linear RGB, each in [0, 1]
  std::vector<float> opacity;         ///< 0 (clear) to 1 (opaque)
  std::vector<float> outline_px;      ///< width of its outline, 0 (none) to 16; below 0: as wide as the picture's
  std::vector<std::int32_t> crease;   ///< lines are drawn between spheres whose numbers differ
  std::vector<std::uint64_t> clips;   ///< bit k: clip k of the scene acts on the sphere
  std::vector<NamedNumbers> numbers;
  std::vector<NamedTexts> texts;
  StatedBonds bonds;

  /// The column of that name, or nullptr.
  const NamedNumbers* find_numbers(std::string_view name) const;
  const NamedTexts* find_texts(std::string_view name) const;

  /// Removes the entries of all spheres whose mask is 0; the others keep their order. The mask has one entry for each
  /// sphere.
  void keep_only(const std::vector<std::uint8_t>& kept);

  /// Those of the spheres of these ids, in their order, which may name a sphere several times. Takes time by the number
  /// of ids and of their bonds alone.
  SphereAttributes part(const std::vector<std::int64_t>& ids) const;

  /// Bytes held by all columns, with their distinct texts.
  std::int64_t allocated_bytes() const;
};

/// Removes the entries whose mask is 0; the others keep their order. An empty array stays empty.
template <class T>
void keep_entries(std::vector<T>& values, const std::vector<std::uint8_t>& kept) {
  if (values.empty()) return;
  std::size_t to = 0;
  for (std::size_t from = 0; from < values.size(); ++from)
    if (kept[from] != 0) values[to++] = values[from];
  values.resize(to);
}

}  // namespace bihive
