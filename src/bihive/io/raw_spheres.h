// The content of a file as its reader finds it, before the steps that all formats share (io/assemble/finish.h).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/geometry/cell.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/io/assemble/assemblies.h"

namespace bihive {

/// What a column `id` says about the rows of a file (io/text/id_order.h).
enum class RowIds {
  none,      ///< the format has none, or the file; rows are spheres in file order
  in_order,  ///< each row has its own, and they increase
  sorted,    ///< the same in another order: the spheres are in that of ids
  repeated,  ///< rows share one: the order of the file is kept
};

/// Centres in the file's own length unit, in file order, or by id where rows have ids. They are finite: the reader
/// checks that, because it knows the line. `r` is either empty (the file gives no radii) or has one finite radius >= 0
/// for each sphere. Attributes as in SphereSet, with bonds in any order.
struct RawSpheres {
  std::string format;           ///< as in SphereFile
  std::string title, entry_id;  ///< as in SphereFile, by title_from() of io/text/title.h
  std::vector<double> x, y, z, r;
  bool has_positions = true;  ///< false: x, y and z are 0, and a trajectory gives them
  SphereAttributes attributes;
  bool assumed_radii = false;            ///< as SphereFile::assumed_radii
  std::optional<double> unknown_radius;  ///< for spheres with neither radius nor known element; >= 0
  Assemblies assemblies;
  std::optional<Cell> cell;
  std::optional<double> time_ps;     ///< picoseconds
  std::optional<std::int64_t> step;  ///< of the simulation
  std::int64_t frames = 1;
  RowIds ids = RowIds::none;
  std::vector<std::string> rules;     ///< what the reader did, one sentence each
  std::vector<std::string> warnings;  ///< what the user should know, one line each

  std::size_t size() const { return x.size(); }
};

/// Adds a bond between two spheres, each by its position in the file, from 1. Without effect if either is none of the
/// spheres that were read.
void add_bond(RawSpheres& spheres, std::optional<std::int64_t> one, std::optional<std::int64_t> other,
              BondOrder order = BondOrder::unknown);

/// The error for a frame that the file does not have.
Error no_such_frame(const std::string& file, std::int64_t frame, std::int64_t frames);

/// "1 sphere has", "2 spheres have".
std::string spheres_have(std::int64_t count);

/// The column with a question mark in place of every control character and every byte that is no UTF-8.
NamedTexts printable_texts(NamedTexts column);

/// Why the number cannot be a coordinate ("is not finite"), or nullptr if it can.
const char* coordinate_fault(double value);

/// Why the number cannot be a radius, or nullptr if it can.
const char* radius_fault(double value);

}  // namespace bihive
