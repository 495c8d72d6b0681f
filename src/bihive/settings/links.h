// Sticks between pairs of spheres that a table lists: contacts, force chains, distances.
#pragma once

#include <string>

namespace bihive {

struct Links {
  std::string file;    ///< a CSV file (scene/links.h); empty: no links
  std::string radius;  ///< a number in world units, or "COLUMN[:F]": F times its values; empty: a quarter of the
                       ///< smaller sphere's
  std::string
      colour;  ///< a colour, or a column as colour_by_from_text() takes an attribute; empty: half by half the spheres'
  bool dashed = false;  ///< dashes instead of whole sticks (scene/pair_line.h)

  bool any() const { return !file.empty(); }
};

}  // namespace bihive
