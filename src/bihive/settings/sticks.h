// Bonds drawn as sticks, and the balls that they join.
#pragma once

namespace bihive {

/// distance: two atoms are bonded that are at most Sticks::reach times the sum of their covalent radii apart
/// (io/bonds.h). file: those that the file states. automatic: those that the file states, and those by distance
/// unless it states all.
enum class Bonds { none, distance, file, automatic };

constexpr double kMostBondReach = 10;

/// Each half of a stick looks like the atom at its end.
struct Sticks {
  Bonds bonds = Bonds::none;
  double reach = 1.2;     ///< above 0, at most kMostBondReach
  double radius = 0.15;   ///< world units (Å), above 0
  bool orders = false;    ///< double, triple and aromatic bonds of the file are parallel sticks (scene/bond_orders.h)
  double ball_scale = 1;  ///< multiplies all radii if there are bonds, >= 0; 0: all become that of the sticks
};

}  // namespace bihive
