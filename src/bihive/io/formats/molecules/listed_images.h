// Finds atoms that a CIF lists although they are images of other listed ones.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "bihive/geometry/cell.h"
#include "bihive/math/vec3.h"

namespace bihive {

/// The images of the atoms so far, by their places. All fractions are from 0 to 1.
class ListedImages {
 public:
  explicit ListedImages(const Cell& cell);

  /// An image of the atom that the file lists at `as_listed`.
  void add(Vec3d fraction, Vec3d as_listed, int element, double occupancy);

  /// Whether an atom at this place would be there twice: an image of another atom of its element is there, at which
  /// that one is not listed, and both together are more than one atom. Disorder at places of their own stays.
  bool is_image_of_another(Vec3d fraction, int element, double occupancy) const;

 private:
  struct Image {
    Vec3d fraction, as_listed;
    int element;
    double occupancy;
  };

  bool is_same_place(Vec3d a, Vec3d b) const;
  std::int64_t box_of(int axis, double fraction, std::int64_t step) const;
  static std::uint64_t key_of(std::int64_t a, std::int64_t b, std::int64_t c);

  Cell cell_;
  std::array<std::int64_t, 3> boxes_{};  // along each vector; larger than the distance of one place
  std::unordered_multimap<std::uint64_t, Image> images_;
};

}  // namespace bihive
