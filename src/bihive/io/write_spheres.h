// From a sphere set to a file of spheres: so that a reader can be checked, and another program can go on.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bihive/geometry/sphere_set.h"

namespace bihive {

enum class SphereFileFormat {
  xyz,           ///< symbol x y z
  extended_xyz,  ///< radius and attributes as properties
  csv,           ///< radius and attributes as columns
  npy,           ///< n x 4: x, y, z, radius
  ply,           ///< ascii; radius, colours and numbers as properties
  sdf,           ///< a molecule: elements, places, whole charges, bonds with orders
  mol2,          ///< the same with names, residues and types, and any charges
};

struct WrittenSpheres {
  std::string bytes;                  ///< the whole file
  std::vector<std::string> left_out;  ///< what the format cannot hold, a sentence each
};

/// World units, in the set's order. Every number is the shortest decimal that reads as the same bits again; NPY holds
/// float32, or float64 if the set's range needs it. Looks (outlines, creases, clips) are left out. Texts are changed
/// where a format has no place for blanks or empty ones; `left_out` says so. docs/formats.md#writing lists the columns.
/// `title`: as SphereFile::title; extended XYZ, SDF and
/// MOL2 have a place for it. Bonds are those that the set states (io/bonds.h has more: state_bonds()).
WrittenSpheres write_spheres(const SphereSet& spheres, SphereFileFormat format, std::string_view title = {});

/// A text as a field of a CSV file: in quotes where its characters need them, whichever separator a reader expects.
std::string csv_field(const std::string& text);

}  // namespace bihive
