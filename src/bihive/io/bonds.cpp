#include "bihive/io/bonds.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <new>
#include <optional>
#include <utility>

#include "bihive/base/memory.h"
#include "bihive/base/watch.h"
#include "bihive/geometry/lattice.h"
#include "bihive/geometry/near_pairs.h"
#include "bihive/io/elements.h"

namespace bihive {
namespace {

constexpr std::uint8_t kHydrogen = 1;

bool knows_elements(const SphereSet& spheres) {
  const std::vector<std::uint8_t>& element = spheres.attributes().element;
  return std::any_of(element.begin(), element.end(), [](std::uint8_t one) { return one != 0; });
}

// Throws as near_pairs().
Result<std::vector<ImagePair>> find_by_distance(const SphereSet& spheres, double reach, int threads) {
  const std::vector<std::uint8_t>& element = spheres.attributes().element;
  std::vector<Vec3d> atoms;
  std::vector<double> radii;
  atoms.reserve(element.size());
  radii.reserve(element.size());
  for (std::int64_t id = 0; id < spheres.size(); ++id) {
    atoms.push_back(spheres.local_centre(id));
    radii.push_back(reach * covalent_radius(element[static_cast<std::size_t>(id)]));
  }
  const Result<std::vector<NearPair>> found = near_pairs(atoms, radii, Lattice::of(spheres.cell()), threads);
  if (!found) return found.error();
  const std::vector<NearPair>& near = *found;

  // Find the nearest one of each hydrogen atom: others of hydrogen count where there is nothing else.
  std::vector<std::int64_t> nearest(atoms.size(), -1);
  const auto is_hydrogen = [&](std::int32_t id) { return element[static_cast<std::size_t>(id)] == kHydrogen; };
  const auto is_of_two = [&](const NearPair& pair) {
    return is_hydrogen(pair.points[0]) && is_hydrogen(pair.points[1]);
  };
  const auto is_nearer = [&](const NearPair& a, const NearPair& b) {
    return std::pair(is_of_two(a), a.distance_squared) < std::pair(is_of_two(b), b.distance_squared);
  };
  for (std::size_t k = 0; k < near.size(); ++k)
    for (const std::int32_t id : near[k].points) {
      if (!is_hydrogen(id)) continue;
      std::int64_t& best = nearest[static_cast<std::size_t>(id)];
      if (best < 0 || is_nearer(near[k], near[static_cast<std::size_t>(best)])) best = static_cast<std::int64_t>(k);
    }

  std::vector<ImagePair> bonds;
  bonds.reserve(near.size());
  for (std::size_t k = 0; k < near.size(); ++k) {
    const auto keeps = [&](std::int32_t id) {
      return !is_hydrogen(id) || nearest[static_cast<std::size_t>(id)] == static_cast<std::int64_t>(k);
    };
    if (keeps(near[k].points[0]) && keeps(near[k].points[1])) bonds.push_back({near[k].points, near[k].image});
  }
  return bonds;
}

}  // namespace

Status check_bond_elements(const SphereSet& spheres) {
  if (knows_elements(spheres)) return Done{};
  return Error{"bonds are found between atoms of known elements, and these spheres have none", "", 0, 0, ""};
}

Result<std::vector<ImagePair>> bonds_by_distance(const SphereSet& spheres, double reach, int threads) {
  if (Status status = check_bond_elements(spheres); !status) return status.error();
  if (spheres.size() > std::numeric_limits<std::int32_t>::max())
    return Error{"bonds are found between at most 2^31 atoms", "", 0, 0, ""};
  WatchedWork work;
  try {
    return find_by_distance(spheres, reach, threads);
  } catch (const Cancelled&) {
    return cancelled_error();
  } catch (const std::bad_alloc&) {
    return no_memory_for("the bonds");
  }
}

std::vector<ImagePair> bonds_of_file(const SphereSet& spheres) {
  const std::optional<Lattice> lattice = Lattice::of(spheres.cell());
  std::vector<ImagePair> bonds;
  bonds.reserve(spheres.attributes().bonds.list.size());
  for (const StatedBond& bond : spheres.attributes().bonds.list) {
    bonds.push_back({{bond.one, bond.other}, {}});
    if (lattice)
      bonds.back().image = nearest_image(spheres.local_centre(bond.one), spheres.local_centre(bond.other), *lattice);
  }
  return bonds;
}

Result<std::vector<ImagePair>> automatic_bonds(const SphereSet& spheres, double reach, int threads) {
  std::vector<ImagePair> stated = bonds_of_file(spheres);
  if (spheres.attributes().bonds.are_all) return stated;
  Result<std::vector<ImagePair>> found = bonds_by_distance(spheres, reach, threads);
  if (!found) return found;
  std::vector<ImagePair> both;
  both.reserve(stated.size() + found->size());
  std::set_union(found->begin(), found->end(), stated.begin(), stated.end(), std::back_inserter(both));
  return both;
}

Result<std::int64_t> state_bonds(SphereSet& spheres, double reach, int threads) {
  StatedBonds& stated = spheres.attributes().bonds;
  if (stated.are_all || !knows_elements(spheres)) return std::int64_t{0};
  const Result<std::vector<ImagePair>> found = bonds_by_distance(spheres, reach, threads);
  if (!found) return found.error();
  const auto before = static_cast<std::int64_t>(stated.list.size());
  for (const ImagePair& bond : *found) stated.add(bond.pair[0], bond.pair[1]);
  stated.put_in_order();
  stated.are_all = !stated.empty();
  return static_cast<std::int64_t>(stated.list.size()) - before;
}

}  // namespace bihive
