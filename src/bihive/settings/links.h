// Sticks between pairs of spheres: those that a table lists (contacts, force chains, distances), or contacts measured
// in the spheres themselves.
#pragma once

#include <limits>
#include <string>

namespace bihive {

struct Links {
  /// The probe of the contacts that are drawn, world units, at least 0 (scene/contact_links.h); infinite: none.
  double contact_probe = std::numeric_limits<double>::infinity();
  std::string radius;  ///< a number in world units, or "COLUMN[:F]": F times its values; empty: a quarter of the
                       ///< smaller sphere's
  std::string
      colour;  ///< a colour, or a column as colour_by_from_text() takes an attribute; empty: half by half the spheres'
  bool dashed = false;  ///< dashes instead of whole sticks (scene/pair_line.h)

  bool shows_contacts() const { return contact_probe < std::numeric_limits<double>::infinity(); }
};

}  // namespace bihive
