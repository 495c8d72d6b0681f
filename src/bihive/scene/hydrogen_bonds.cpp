#include "bihive/scene/hydrogen_bonds.h"

#include <algorithm>
#include <new>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "bihive/base/memory.h"
#include "bihive/base/watch.h"
#include "bihive/geometry/near_pairs.h"
#include "bihive/io/bonds.h"
#include "bihive/scene/pair_line.h"
#include "bihive/scene/stick_colours.h"
#include "bihive/select/residues.h"
#include "bihive/select/selection.h"

namespace bihive {
namespace {

constexpr std::uint8_t kElementH = 1, kElementN = 7, kElementO = 8, kElementF = 9;

// Farther than any donor is from an acceptor: a hydrogen atom is at most 1.3 Å from its donor.
constexpr double kFarthestPair = kFarthestFromHydrogen + 1.3;

constexpr const char* kDonatesOnly =
    "protein and ((name N and not resname PRO) or (resname LYS and name NZ) or (resname ARG and name NE NH1 NH2) or "
    "(resname TRP and name NE1) or (resname ASN and name ND2) or (resname GLN and name NE2))";
constexpr const char* kAcceptsOnly =
    "(protein and (name O OXT or (resname ASP ASN and name OD1 OD2) or (resname GLU GLN and name OE1 OE2) or (resname "
    "PRO and name N))) or (nucleic and name OP1 OP2 O1P O2P O2 O4 O6)";

// None where the input has no such names.
std::vector<std::uint8_t> mask_of(const SphereSet& spheres, const char* selection) {
  Result<std::vector<std::uint8_t>> mask = select_spheres(spheres, selection);
  return mask ? std::move(*mask) : std::vector<std::uint8_t>(static_cast<std::size_t>(spheres.size()));
}

struct Neighbour {
  std::int32_t atom;
  ImageCounts image;
};

class HydrogenBondSearch {
 public:
  HydrogenBondSearch(const SphereSet& spheres, const std::vector<ImagePair>& bonds)
      : spheres_(spheres),
        element_(spheres.attributes().element),
        lattice_(Lattice::of(spheres.cell())),
        neighbours_(element_.size()),
        donates_only_(mask_of(spheres, kDonatesOnly)),
        accepts_only_(mask_of(spheres, kAcceptsOnly)) {
    for (const ImagePair& bond : bonds) {
      neighbours_[at(bond.pair[0])].push_back({bond.pair[1], bond.image});
      neighbours_[at(bond.pair[1])].push_back({bond.pair[0], ImageCounts{} - bond.image});
    }
    const Result<std::vector<std::int32_t>> residues = residue_of_spheres(spheres);
    residue_ = residues ? *residues : std::vector<std::int32_t>(element_.size());
    for (std::size_t i = 0; i < element_.size(); ++i) {
      const auto residue = static_cast<std::size_t>(residue_[i]);
      if (has_hydrogens_.size() <= residue) has_hydrogens_.resize(residue + 1);
      if (element_[i] == kElementH) has_hydrogens_[residue] = 1;
    }
  }

  // Throws as near_pairs().
  Result<std::vector<HydrogenBond>> find(int threads) {
    std::vector<Vec3d> centres;
    std::vector<double> radii;
    for (std::int64_t id = 0; id < spheres_.size(); ++id) {
      const std::uint8_t element = element_[static_cast<std::size_t>(id)];
      const bool is_polar = element == kElementN || element == kElementO || element == kElementF;
      centres.push_back(spheres_.local_centre(id));
      radii.push_back(is_polar ? kFarthestPair / 2 : 0);
    }
    const Result<std::vector<NearPair>> near = near_pairs(centres, radii, lattice_, threads);
    if (!near) return near.error();
    for (const NearPair& pair : *near) {
      const auto [one, other] = pair.points;
      if (is_near_by_bonds(one, other, pair.image)) continue;
      const bool found = judge(one, other, pair.image, false);
      judge(other, one, ImageCounts{} - pair.image, found);
    }
    std::sort(found_.begin(), found_.end(), [](const Found& a, const Found& b) {
      return std::tie(a.donor, a.bond.from, a.bond.acceptor, a.bond.image) <
             std::tie(b.donor, b.bond.from, b.bond.acceptor, b.bond.image);
    });
    std::vector<HydrogenBond> bonds;
    for (const Found& one : found_) bonds.push_back(one.bond);
    return bonds;
  }

 private:
  struct Found {
    std::int32_t donor;
    HydrogenBond bond;
  };

  static std::size_t at(std::int32_t id) { return static_cast<std::size_t>(id); }
  Vec3d position(std::int32_t id, const ImageCounts& image) const {
    const Vec3d centre = spheres_.local_centre(id);
    return lattice_ ? centre + lattice_->shift(image) : centre;
  }

  // Bonded, or bonded to a common atom.
  bool is_near_by_bonds(std::int32_t one, std::int32_t other, const ImageCounts& image) const {
    for (const Neighbour& near : neighbours_[at(one)]) {
      if (near.atom == other && near.image == image) return true;
      for (const Neighbour& next : neighbours_[at(near.atom)])
        if (next.atom == other && near.image + next.image == image) return true;
    }
    return false;
  }

  // Whether an angle at `corner` between two directions is at least 90 degrees for all bonded atoms but hydrogen.
  bool is_open(std::int32_t corner, const ImageCounts& image, Vec3d towards) const {
    const Vec3d centre = position(corner, image);
    const std::vector<Neighbour>& near = neighbours_[at(corner)];
    return std::all_of(near.begin(), near.end(), [&](const Neighbour& one) {
      if (element_[at(one.atom)] == kElementH) return true;
      return dot(position(one.atom, image + one.image) - centre, towards - centre) <= 0;
    });
  }

  // `image`: of the acceptor. `is_known`: the pair has a line already, in the other direction. Returns whether it has
  // one now.
  bool judge(std::int32_t donor, std::int32_t acceptor, const ImageCounts& image, bool is_known) {
    if (donates_only_[at(acceptor)] != 0) return false;
    const Vec3d from = position(donor, {}), to = position(acceptor, image);
    if (has_hydrogens_[static_cast<std::size_t>(residue_[at(donor)])] != 0) {
      bool found = false;
      for (const Neighbour& near : neighbours_[at(donor)]) {
        if (element_[at(near.atom)] != kElementH) continue;
        const Vec3d hydrogen = position(near.atom, near.image);
        const Vec3d back = from - hydrogen, on = to - hydrogen;
        const double distance = length(on);
        if (!(distance <= kFarthestFromHydrogen) || !(dot(back, on) <= kCosineAtHydrogen * length(back) * distance))
          continue;
        found_.push_back({donor, {near.atom, acceptor, image - near.image}});
        found = true;
      }
      return found;
    }
    if (is_known || accepts_only_[at(donor)] != 0) return false;
    if (!(length(to - from) <= kFarthestFromDonor)) return false;
    if (!is_open(donor, {}, to) || !is_open(acceptor, image, from)) return false;
    found_.push_back({donor, {donor, acceptor, image}});
    return true;
  }

  const SphereSet& spheres_;
  const std::vector<std::uint8_t>& element_;
  std::optional<Lattice> lattice_;
  std::vector<std::vector<Neighbour>> neighbours_;  // of each atom
  std::vector<std::uint8_t> donates_only_, accepts_only_, has_hydrogens_;
  std::vector<std::int32_t> residue_;
  std::vector<Found> found_;
};

}  // namespace

Result<std::vector<HydrogenBond>> find_hydrogen_bonds(const SphereSet& spheres, int threads) {
  const Result<std::vector<ImagePair>> bonds = bonds_by_distance(spheres, Sticks().reach, threads);
  if (!bonds) return bonds.error();
  WatchedWork work;
  try {
    return HydrogenBondSearch(spheres, *bonds).find(threads);
  } catch (const Cancelled&) {
    return cancelled_error();
  } catch (const std::bad_alloc&) {
    return no_memory_for("the hydrogen bonds");
  }
}

Result<std::int64_t> add_hydrogen_bonds(Scene& scene, const HydrogenBonds& bonds, int threads) {
  const Result<std::vector<HydrogenBond>> found = find_hydrogen_bonds(scene.spheres, threads);
  if (!found) return error_of_setting("hbonds", found.error());
  const std::optional<Lattice> lattice = Lattice::of(scene.spheres.cell());
  std::vector<OwnStick> sticks;
  for (const HydrogenBond& one : *found)
    add_pair_line(scene.spheres, lattice,
                  {one.from, one.acceptor, one.image, bonds.radius, to_float(bonds.colour), true}, sticks);
  if (Status status = scene.sticks.add(scene.spheres, sticks); !status)
    return error_of_setting("hbonds", status.error());
  return static_cast<std::int64_t>(found->size());
}

}  // namespace bihive
