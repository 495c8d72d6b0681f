// Colours for spheres without colours: by element (CPK) or by type.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "bihive/geometry/sphere_set.h"
#include "bihive/math/vec3.h"
#include "bihive/scene/names.h"

namespace bihive {

/// Colours of elements, or else of types. jmol: the bright colours that chemists know. soft: muted ones for printing.
enum class ElementScheme { jmol, soft };
inline const Names<ElementScheme> kElementSchemes{{"jmol", ElementScheme::jmol}, {"soft", ElementScheme::soft}};

/// Linear RGB of a chemical element by atomic number (0 or unknown: pink).
Vec3f element_colour(int atomic_number, ElementScheme scheme = ElementScheme::jmol);

/// Those of all elements, by atomic number below kElementNumbers.
constexpr int kElementNumbers = 119;  // 0: unknown
std::vector<Vec3f> element_colours_of(ElementScheme scheme);

/// Linear RGB of a particle type: different for forty numbers in a row, of which the first eight differ most. Any
/// integer. jmol: the colours of the map okabe-ito; soft: greyer ones.
Vec3f type_colour(std::int32_t type, ElementScheme scheme = ElementScheme::jmol);

/// Fills the colour attribute if it is empty: from elements if there are any, else from types. Without both it stays
/// empty. Returns the attribute used ("element", "type"), or an empty text.
std::string_view colour_spheres(SphereSet& spheres, ElementScheme scheme = ElementScheme::jmol);

}  // namespace bihive
