#include "bihive/io/formats/molecules/alternates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace bihive {

std::size_t Alternates::number_of(std::string_view name) {
  return numbers_.try_emplace(std::string(name), numbers_.size()).first->second;
}

void Alternates::add(const AlternateAtom& atom, std::size_t index) {
  const double occupancy = std::isnan(atom.occupancy) ? 0 : atom.occupancy;
  atoms_.push_back(
      {number_of(atom.residue), number_of(atom.component), number_of(atom.name), atom.mark, occupancy, index});
}

// Residues of several names: unmarks the atoms of all names but one. Returns how many residues there were, and the
// atoms that stay as far as names tell; those of the conformer that stays are made likelier than the others.
std::size_t Alternates::drop_components(std::vector<std::uint8_t>& kept, std::vector<Atom>& left) const {
  // Sum up the conformers of each residue, in order of appearance. Names that share a mark are no alternatives: a
  // simulation used the residue's number again.
  struct Residue {
    std::vector<Conformer> conformers;  // at most one a mark
    bool names_share_a_mark = false;
  };
  std::unordered_map<std::size_t, Residue> residues;
  for (const Atom& atom : atoms_) {
    Residue& residue = residues[atom.residue];
    auto found = std::find_if(residue.conformers.begin(), residue.conformers.end(),
                              [&atom](const Conformer& conformer) { return conformer.mark == atom.mark; });
    if (found == residue.conformers.end()) found = residue.conformers.insert(found, {atom.component, atom.mark, 0, 0});
    residue.names_share_a_mark = residue.names_share_a_mark || found->component != atom.component;
    found->occupancy_sum += atom.occupancy;
    found->atoms += 1;
  }

  // Choose one of each.
  std::unordered_map<std::size_t, Conformer> chosen;
  for (const auto& [number, residue] : residues) {
    const std::vector<Conformer>& all = residue.conformers;
    const bool several =
        std::any_of(all.begin(), all.end(), [&all](const Conformer& one) { return one.component != all[0].component; });
    if (!several || residue.names_share_a_mark) continue;
    chosen.emplace(number, *std::max_element(all.begin(), all.end(), [](const Conformer& a, const Conformer& b) {
                     return a.occupancy_sum / a.atoms < b.occupancy_sum / b.atoms;
                   }));
  }

  // Take the atoms that stay.
  for (Atom atom : atoms_) {
    if (const auto found = chosen.find(atom.residue); found != chosen.end()) {
      if (atom.component != found->second.component) {
        kept[atom.index] = 0;
        continue;
      }
      if (atom.mark == found->second.mark) atom.occupancy = std::numeric_limits<double>::infinity();
    }
    left.push_back(atom);
  }
  return chosen.size();
}

void Alternates::remove_from(RawSpheres& spheres) const {
  if (atoms_.empty()) return;
  std::vector<std::uint8_t> kept(spheres.size(), 1);
  std::vector<Atom> atoms;
  const std::size_t heterogeneous = drop_components(kept, atoms);

  // Of each site keep the likeliest place.
  struct Site {
    std::string marks;
    double occupancy;
    std::size_t index;
  };
  std::map<std::pair<std::size_t, std::size_t>, Site> sites;
  for (const Atom& atom : atoms) {
    const Site first{std::string(1, atom.mark), atom.occupancy, atom.index};
    const auto [entry, is_new] = sites.try_emplace({atom.residue, atom.name}, first);
    if (is_new) continue;
    Site& best = entry->second;
    if (best.marks.find(atom.mark) != std::string::npos) {
      best = first;
      continue;
    }
    best.marks += atom.mark;
    const bool likelier = atom.occupancy > best.occupancy;
    kept[likelier ? best.index : atom.index] = 0;
    if (likelier) {
      best.occupancy = atom.occupancy;
      best.index = atom.index;
    }
  }

  const std::int64_t removed = std::count(kept.begin(), kept.end(), std::uint8_t{0});
  if (removed == 0) return;
  for (auto* values : {&spheres.x, &spheres.y, &spheres.z, &spheres.r}) keep_entries(*values, kept);
  spheres.attributes.keep_only(kept);
  spheres.rules.push_back("alternate locations: the highest occupancy, of equal ones the first; " +
                          std::to_string(removed) + " atoms left out");
  if (heterogeneous > 0)
    spheres.rules.push_back("residues of several names at one place: the likeliest as a whole; " +
                            std::to_string(heterogeneous) + (heterogeneous == 1 ? " residue" : " residues"));
}

}  // namespace bihive
