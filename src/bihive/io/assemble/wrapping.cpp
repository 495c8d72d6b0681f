#include "bihive/io/assemble/wrapping.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "bihive/base/parse_number.h"
#include "bihive/base/setting_name.h"
#include "bihive/io/column_choice.h"
#include "bihive/io/residue_runs.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

// Places as shares of the cell's vectors.
class Shares {
 public:
  explicit Shares(const Cell& cell) : cell_(cell) {
    const auto& [a, b, c] = cell.vectors;
    // Lengths near 1, so that no product is too large or too small.
    double largest = 0;
    for (const Vec3d& v : cell.vectors)
      for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs(v[axis]));
    if (!(largest > 0)) return;
    scale_ = std::ldexp(1, -std::ilogb(largest));
    const Vec3d as = a * scale_, bs = b * scale_, cs = c * scale_;
    const double volume = dot(as, cross(bs, cs));
    if (volume == 0) return;
    rows_ = {cross(bs, cs) / volume, cross(cs, as) / volume, cross(as, bs) / volume};
    has_volume_ = is_finite(rows_[0]) && is_finite(rows_[1]) && is_finite(rows_[2]);
  }
  bool has_volume() const { return has_volume_; }
  Vec3d of(Vec3d vector) const {
    const Vec3d scaled = vector * scale_;
    return {dot(scaled, rows_[0]), dot(scaled, rows_[1]), dot(scaled, rows_[2])};
  }
  Vec3d vectors(Vec3d counts) const {
    return counts.x * cell_.vectors[0] + counts.y * cell_.vectors[1] + counts.z * cell_.vectors[2];
  }
  Vec3d origin() const { return cell_.origin; }

 private:
  Cell cell_;
  double scale_ = 1;
  std::array<Vec3d, 3> rows_;
  bool has_volume_ = false;
};

Vec3d floors(Vec3d v) {
  return {std::floor(v.x), std::floor(v.y), std::floor(v.z)};
}

Vec3d place_of(const RawSpheres& raw, std::size_t i) {
  return {raw.x[i], raw.y[i], raw.z[i]};
}
void put(RawSpheres& raw, std::size_t i, Vec3d at) {
  raw.x[i] = at.x;
  raw.y[i] = at.y;
  raw.z[i] = at.z;
}

void wrap(RawSpheres& raw, const Shares& shares) {
  for (std::size_t i = 0; i < raw.size(); ++i) {
    Vec3d at = place_of(raw, i);
    // Rounding may leave a centre on the far border, which is the near one of the next cell.
    for (int turn = 0; turn < 2; ++turn) at = at - shares.vectors(floors(shares.of(at - shares.origin())));
    put(raw, i, at);
  }
  raw.rules.push_back("wrapped: every centre moved into the cell by whole vectors");
}

const NamedNumbers* column_of(const RawSpheres& raw, std::span<const std::string_view> names) {
  for (const std::string_view name : names)
    for (const NamedNumbers& column : raw.attributes.numbers)
      if (lower_case(column.name) == name) return &column;
  return nullptr;
}

const NamedNumbers* column_of(const RawSpheres& raw, std::string_view name) {
  return column_of(raw, {&name, 1});
}

Error no_flag(const RawSpheres&, std::size_t i, const std::string& name) {
  return {"sphere " + std::to_string(i) + ": the image flags ix, iy and iz must be whole numbers below 2^31", name, 0,
          0, ""};
}

Status unwrap_by_flags(RawSpheres& raw, const Shares& shares, const std::array<const NamedNumbers*, 3>& flags,
                       const std::string& name) {
  for (std::size_t i = 0; i < raw.size(); ++i) {
    Vec3d counts;
    for (int axis = 0; axis < 3; ++axis) {
      counts[axis] = flags[static_cast<std::size_t>(axis)]->values[i];
      if (!(std::abs(counts[axis]) < 0x1p31) || counts[axis] != std::floor(counts[axis])) return no_flag(raw, i, name);
    }
    put(raw, i, place_of(raw, i) + shares.vectors(counts));
  }
  raw.rules.push_back("unwrapped: by the image flags ix, iy, iz");
  return Done{};
}

// The shortest of the vectors that differ by whole vectors of the cell.
Vec3d shortest(Vec3d step, const Shares& shares) {
  const Vec3d share = shares.of(step);
  const Vec3d base = step - shares.vectors(floors(share + Vec3d{0.5, 0.5, 0.5}));
  Vec3d best = base;
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j)
      for (int k = -1; k <= 1; ++k) {
        const Vec3d other = base + shares.vectors({double(i), double(j), double(k)});
        if (dot(other, other) < dot(best, best)) best = other;
      }
  return best;
}

// Which spheres belong together, as far as the file tells: pairs of neighbours in a molecule, and how they are known.
struct Together {
  std::vector<std::array<std::size_t, 2>> pairs;
  std::string known_by;
};

// Spheres of equal numbers, each with the one before it in the order of the file. Those of NaN belong to no molecule.
Together by_molecule(const NamedNumbers& molecule) {
  Together together{{}, "the spheres of a molecule (" + molecule.name + ") each next to the one before"};
  std::map<double, std::size_t> last;
  for (std::size_t i = 0; i < molecule.values.size(); ++i) {
    const double number = molecule.values[i];
    if (std::isnan(number)) continue;
    const auto [known, is_first] = last.try_emplace(number, i);
    if (!is_first) together.pairs.push_back({known->second, i});
    known->second = i;
  }
  return together;
}

Together by_bonds(const RawSpheres& raw) {
  Together together{{}, "along the bonds that the file states"};
  for (const StatedBond& bond : raw.attributes.bonds.list)
    together.pairs.push_back({static_cast<std::size_t>(bond.one), static_cast<std::size_t>(bond.other)});
  return together;
}

Together by_residue(const RawSpheres& raw, const NamedNumbers& number) {
  Together together{{}, "the spheres of a residue (chain, number and name) each next to the one before"};
  const std::vector<std::int32_t> residues =
      residue_runs(raw.attributes, raw.size(), [&](std::size_t i) { return number.values[i]; });
  for (std::size_t i = 1; i < residues.size(); ++i)
    if (residues[i] == residues[i - 1]) together.pairs.push_back({i - 1, i});
  return together;
}

std::optional<Together> find_together(const RawSpheres& raw) {
  if (const NamedNumbers* const molecule = column_of(raw, kMoleculeColumns)) return by_molecule(*molecule);
  const NamedNumbers* const residue = column_of(raw, "resid");
  const StatedBonds& bonds = raw.attributes.bonds;
  if (bonds.empty()) return residue != nullptr ? std::optional(by_residue(raw, *residue)) : std::nullopt;
  if (residue == nullptr || bonds.are_all) return by_bonds(raw);
  Together together = by_bonds(raw), residues = by_residue(raw, *residue);
  together.pairs.insert(together.pairs.end(), residues.pairs.begin(), residues.pairs.end());
  together.known_by += ", and " + residues.known_by;
  return together;
}

// Brings each sphere to the image that is nearest to a neighbour which is in its place already. The first sphere of a
// molecule in the order of the file stays where it is. Returns the molecules, each as the positions of its spheres.
std::vector<std::vector<std::size_t>> bring_together(RawSpheres& raw, const Shares& shares, const Together& together) {
  // The neighbours of sphere i are those from begin[i] to before begin[i + 1].
  std::vector<std::size_t> begin(raw.size() + 1, 0), neighbours(2 * together.pairs.size());
  for (const auto& pair : together.pairs)
    for (const std::size_t end : pair) ++begin[end + 1];
  for (std::size_t i = 0; i < raw.size(); ++i) begin[i + 1] += begin[i];
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  for (const auto& [one, other] : together.pairs) {
    neighbours[next[one]++] = other;
    neighbours[next[other]++] = one;
  }
  std::vector<std::vector<std::size_t>> molecules;
  std::vector<bool> is_placed(raw.size(), false);
  for (std::size_t first = 0; first < raw.size(); ++first) {
    if (is_placed[first]) continue;
    std::vector<std::size_t> molecule{first};
    is_placed[first] = true;
    for (std::size_t k = 0; k < molecule.size(); ++k) {
      const Vec3d at = place_of(raw, molecule[k]);
      for (std::size_t n = begin[molecule[k]]; n < begin[molecule[k] + 1]; ++n) {
        const std::size_t other = neighbours[n];
        if (is_placed[other]) continue;
        is_placed[other] = true;
        put(raw, other, at + shortest(place_of(raw, other) - at, shares));
        molecule.push_back(other);
      }
    }
    molecules.push_back(std::move(molecule));
  }
  return molecules;
}

// Moves each molecule, which is whole, so that the mean of its centres is in the cell.
void wrap_whole(RawSpheres& raw, const Shares& shares, const std::vector<std::vector<std::size_t>>& molecules) {
  for (const std::vector<std::size_t>& molecule : molecules) {
    for (int turn = 0; turn < 2; ++turn) {
      Vec3d middle;
      for (const std::size_t i : molecule) middle = middle + place_of(raw, i) / double(molecule.size());
      const Vec3d by = shares.vectors(floors(shares.of(middle - shares.origin())));
      if (by == Vec3d{}) break;
      for (const std::size_t i : molecule) put(raw, i, place_of(raw, i) - by);
    }
  }
}

}  // namespace

Status apply_wrapping(RawSpheres& raw, Wrapping wrapping, const std::string& name) {
  if (wrapping == Wrapping::none) return Done{};
  const std::string what = wrapping == Wrapping::unwrap ? "unwrap" : "wrap";
  if (!raw.cell)
    return Error{"there is no periodic cell to " + what + " by", name, 0, 0,
                 "give one with " + setting_name("cell_vectors")};
  const Shares shares(*raw.cell);
  if (!shares.has_volume()) return Error{"the cell has no volume, so nothing can " + what, name, 0, 0, ""};
  if (wrapping == Wrapping::wrap) {
    wrap(raw, shares);
    return Done{};
  }
  const std::array<const NamedNumbers*, 3> flags{column_of(raw, "ix"), column_of(raw, "iy"), column_of(raw, "iz")};
  if (wrapping == Wrapping::unwrap && flags[0] != nullptr && flags[1] != nullptr && flags[2] != nullptr)
    return unwrap_by_flags(raw, shares, flags, name);
  const std::optional<Together> together = find_together(raw);
  if (!together)
    return Error{"nothing says which spheres belong together", name, 0, 0,
                 std::string(wrapping == Wrapping::unwrap ? "unwrapping needs columns ix, iy and iz, or"
                                                          : "wrapping molecules needs") +
                     " a column mol, bonds (MOL2, SDF) or residues (PDB, mmCIF, GRO)"};
  const std::vector<std::vector<std::size_t>> molecules = bring_together(raw, shares, *together);
  raw.rules.push_back("unwrapped: " + together->known_by);
  if (wrapping != Wrapping::wrap_molecules) return Done{};
  wrap_whole(raw, shares, molecules);
  raw.rules.push_back("wrapped: every molecule as a whole, its middle into the cell");
  return Done{};
}

}  // namespace bihive
