// Tubes through the beads of chains.
#pragma once

#include <string>

namespace bihive {

/// The spheres that share a tube: those of equal attribute `chain` or `mol`, in their order.
enum class TraceBy { none, chain, mol };

/// Other spheres of a traced chain (scene/traces.h): not drawn, or drawn as they are.
enum class TraceAtoms { hidden, shown };

struct Traces {
  TraceBy by = TraceBy::none;
  std::string select;  ///< the beads, a selection (docs/selections.md); empty: CA of proteins and P of nucleic acids,
                       ///< or all spheres where there are none
  std::string radius;  ///< world units: a number, or an attribute or arithmetic of such; empty: a quarter of the bead's
  TraceAtoms atoms = TraceAtoms::hidden;

  bool any() const { return by != TraceBy::none; }
};

}  // namespace bihive
