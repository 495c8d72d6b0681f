#include "bihive/scene/bond_orders.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "bihive/geometry/lattice.h"

namespace bihive {
namespace {

constexpr double kOffAxis = 1.0 / 32;                       // the square of the sine of 10 degrees, about
constexpr std::size_t kMostSearched = 64;                   // atoms, until a molecule counts as one on a line
constexpr std::size_t kLargestRing = 8;                     // aromatic bonds
constexpr std::size_t kMostInRings = 512;                   // atoms, until a bond counts as one in no ring
constexpr double kPeriodOfDashes = 6, kShareOfDash = 0.25;  // in radii, and in periods without the round ends

/// An atom as it is seen from another one: moved by `image`.
struct SeenAtom {
  std::int32_t id = 0;
  ImageCounts image{};

  friend bool operator==(const SeenAtom& a, const SeenAtom& b) { return a.id == b.id && a.image == b.image; }
};

/// The atoms that are bonded to each atom, in ascending order.
class BondedAtoms {
 public:
  struct Entry {
    SeenAtom atom;
    bool is_aromatic;
  };

  BondedAtoms(std::int64_t atoms, const std::vector<ImagePair>& bonds, const std::vector<BondOrder>& orders)
      : begins_(static_cast<std::size_t>(atoms) + 1), entries_(2 * bonds.size()) {
    for (const ImagePair& bond : bonds)
      for (const std::int32_t id : bond.pair) ++begins_[static_cast<std::size_t>(id) + 1];
    for (std::size_t i = 1; i < begins_.size(); ++i) begins_[i] += begins_[i - 1];
    std::vector<std::size_t> next(begins_.begin(), begins_.end() - 1);
    for (std::size_t k = 0; k < bonds.size(); ++k) {
      const auto& [pair, image] = bonds[k];
      const bool is_aromatic = orders[k] == BondOrder::aromatic;
      entries_[next[static_cast<std::size_t>(pair[0])]++] = {{pair[1], image}, is_aromatic};
      entries_[next[static_cast<std::size_t>(pair[1])]++] = {{pair[0], ImageCounts{} - image}, is_aromatic};
    }
  }

  template <class Use>
  void for_each(const SeenAtom& of, const Use& use) const {
    const auto i = static_cast<std::size_t>(of.id);
    for (std::size_t k = begins_[i]; k < begins_[i + 1]; ++k)
      use(SeenAtom{entries_[k].atom.id, of.image + entries_[k].atom.image}, entries_[k].is_aromatic);
  }

 private:
  std::vector<std::size_t> begins_;
  std::vector<Entry> entries_;
};

/// Makes the sticks of one bond after the other.
class ParallelBonds {
 public:
  ParallelBonds(const SphereSet& spheres, const std::vector<ImagePair>& bonds, const std::vector<BondOrder>& orders,
                double radius, const std::function<bool(const SpherePair&)>& is_parted)
      : spheres_(spheres),
        lattice_(Lattice::of(spheres.cell())),
        bonded_(spheres.size(), bonds, orders),
        radius_(radius),
        is_parted_(is_parted) {}

  void add(const ImagePair& bond, BondOrder order) {
    one_ = {bond.pair[0], {}};
    other_ = {bond.pair[1], bond.image};
    shift_ = bond.is_image() ? lattice_->shift(bond.image) : Vec3d{};
    parted_ = bond.is_image() || (is_parted_ && is_parted_(bond.pair));
    from_ = spheres_.local_centre(one_.id);
    to_ = place(other_);
    if (!(length(to_ - from_) > 0)) return add_solid({}, {}, radius_);
    axis_ = normalized(to_ - from_);
    if (order == BondOrder::aromatic) return add_aromatic();
    const Vec3d side = side_of_plane();
    const ParallelSticks& sticks = order == BondOrder::triple ? kTripleBond : kDoubleBond;
    const Vec3d step = sticks.spacing * radius_ * side;
    for (const double k : {-1.0, 0.0, 1.0}) {
      if (order == BondOrder::triple)
        add_solid(k * step, k * step, sticks.radius * radius_);
      else if (k != 0)
        add_solid(0.5 * k * step, 0.5 * k * step, sticks.radius * radius_);
    }
  }

  std::vector<OwnStick> take() { return std::move(sticks_); }

 private:
  Vec3d place(const SeenAtom& atom) const {
    const Vec3d at = spheres_.local_centre(atom.id);
    return lattice_ ? at + lattice_->shift(atom.image) : at;
  }

  // ---- Sides ----

  // The part of a vector across the axis.
  Vec3d across(Vec3d vector) const { return vector - dot(vector, axis_) * axis_; }

  // Of length 1, across the axis, in the plane of the bond.
  Vec3d side_of_plane() const {
    struct Reached {
      SeenAtom atom;
      bool from_other;
    };
    std::vector<Reached> reached{{one_, false}, {other_, true}};
    std::optional<Vec3d> side;
    for (std::size_t k = 0; k < reached.size() && reached.size() < kMostSearched && !side; ++k) {
      const Reached at = reached[k];
      const Vec3d end = at.from_other ? to_ : from_;
      bonded_.for_each(at.atom, [&](const SeenAtom& next, bool) {
        if (side || std::any_of(reached.begin(), reached.end(), [&](const Reached& r) { return r.atom == next; }))
          return;
        const Vec3d apart = place(next) - end, off_axis = across(apart);
        if (dot(off_axis, off_axis) > kOffAxis * dot(apart, apart)) side = normalized(off_axis);
        reached.push_back({next, at.from_other});
      });
    }
    if (side) return *side;
    int most_across = 0;
    for (int k = 1; k < 3; ++k)
      if (std::abs(axis_[k]) < std::abs(axis_[most_across])) most_across = k;
    Vec3d world;
    world[most_across] = 1;
    return normalized(across(world));
  }

  // The centre of the smallest ring of aromatic bonds.
  std::optional<Vec3d> centre_of_ring() const {
    struct Reached {
      SeenAtom atom;
      std::size_t before, bonds;
    };
    std::vector<Reached> reached{{one_, 0, 0}};
    for (std::size_t k = 0; k < reached.size() && reached.size() < kMostInRings; ++k) {
      const Reached at = reached[k];
      if (at.bonds + 1 >= kLargestRing) break;
      bool closes = false;
      bonded_.for_each(at.atom, [&](const SeenAtom& next, bool is_aromatic) {
        if (closes || !is_aromatic || (k == 0 && next == other_)) return;
        closes = next == other_;
        if (!closes && std::none_of(reached.begin(), reached.end(), [&](const Reached& r) { return r.atom == next; }))
          reached.push_back({next, k, at.bonds + 1});
      });
      if (!closes) continue;
      Vec3d sum = to_;
      for (std::size_t i = k;; i = reached[i].before) {
        sum = sum + place(reached[i].atom);
        if (i == 0) break;
      }
      return (1 / double(at.bonds + 2)) * sum;
    }
    return std::nullopt;
  }

  // ---- Sticks ----

  void add_aromatic() {
    const double spacing = kAromaticBond.spacing * radius_, radius = kRadiusOfDashes * radius_;
    add_solid({}, {}, kAromaticBond.radius * radius_);
    if (const std::optional<Vec3d> centre = centre_of_ring()) {
      const Vec3d inward = across(*centre - from_);
      const double distance = length(inward);
      if (distance > spacing) {
        const double share = spacing / distance;
        return add_dashes(share * (*centre - from_), share * (*centre - to_), radius);
      }
    }
    const Vec3d side = spacing * side_of_plane();
    add_dashes(side, side, radius);
  }

  // From `begin` to `end` of the line from this far beside the first atom to this far beside the second.
  void add_piece(Vec3d beside_one, Vec3d beside_other, double begin, double end, double radius) {
    const Vec3d from = from_ + beside_one, to = to_ + beside_other;
    const auto at = [&](double share) { return share == 1 ? to : from + share * (to - from); };
    OwnStick stick;
    stick.radius_a = stick.radius_b = radius;
    const auto add_half = [&](double first, double last, const SeenAtom& atom) {
      const Vec3d moved = atom == other_ ? shift_ : Vec3d{};
      stick.a = at(first) - moved;
      stick.b = at(last) - moved;
      stick.sphere = atom.id;
      sticks_.push_back(stick);
    };
    if (end <= 0.5) return add_half(begin, end, one_);
    if (begin >= 0.5) return add_half(begin, end, other_);
    if (parted_) {
      add_half(begin, 0.5, one_);
      add_half(0.5, end, other_);
      return;
    }
    stick.a = at(begin);
    stick.b = at(end);
    stick.sphere = one_.id;
    stick.other = other_.id;
    sticks_.push_back(stick);
  }
  void add_solid(Vec3d beside_one, Vec3d beside_other, double radius) {
    add_piece(beside_one, beside_other, 0, 1, radius);
  }
  // An odd number of them, so that one lies in the middle.
  void add_dashes(Vec3d beside_one, Vec3d beside_other, double radius) {
    const double whole = length((to_ + beside_other) - (from_ + beside_one));
    const double gaps = std::max(2.0, 2 * std::round(0.5 * whole / (kPeriodOfDashes * radius)));
    const double period = 1 / (gaps + kShareOfDash);
    for (double k = 0; k <= gaps; ++k)
      add_piece(beside_one, beside_other, k * period, k == gaps ? 1 : (k + kShareOfDash) * period, radius);
  }

  const SphereSet& spheres_;
  const std::optional<Lattice> lattice_;
  const BondedAtoms bonded_;
  const double radius_;
  const std::function<bool(const SpherePair&)>& is_parted_;

  // The bond.
  SeenAtom one_, other_;
  Vec3d from_, to_, shift_, axis_;
  bool parted_ = false;
  std::vector<OwnStick> sticks_;
};

}  // namespace

std::vector<OwnStick> parallel_sticks(const SphereSet& spheres, const std::vector<ImagePair>& bonds,
                                      const std::vector<BondOrder>& orders, double radius,
                                      const std::function<bool(const SpherePair&)>& is_parted) {
  if (std::none_of(orders.begin(), orders.end(), has_parallel_sticks)) return {};
  ParallelBonds made(spheres, bonds, orders, radius, is_parted);
  for (std::size_t k = 0; k < bonds.size(); ++k)
    if (has_parallel_sticks(orders[k])) made.add(bonds[k], orders[k]);
  return made.take();
}

}  // namespace bihive
