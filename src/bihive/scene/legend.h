// The content of a legend: the meaning of the spheres' colours (Scene::coloured_by).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bihive/scene/colour_maps.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// A continuous map and its range.
struct LegendScale {
  ColourMap map;
  std::pair<double, double> range;
  bool logarithmic = false;
};

/// A colour of the screen, each value from 0 to 1, and its name.
struct LegendEntry {
  std::string name;
  Vec3d colour;
};

/// One attribute by which spheres are coloured.
struct LegendKey {
  std::string title;                 ///< the attribute's name; empty: names of selections
  std::optional<LegendScale> scale;  ///< unset: categories
  std::vector<LegendEntry> entries;  ///< categories; of a scale: the colour of unknown numbers, if there are any
};

/// A key for each attribute that colours at least one sphere, in the order of Scene::coloured_by, then one with the
/// names of selections (Scene::legend_names), then the scales of arrows and links (Scene::sticks_coloured_by). Two keys
/// of one attribute whose categories have the same colours are one. Categories are those of the present spheres:
/// elements and numbers from low to high, texts in the input's order. Costs a pass over all spheres.
std::vector<LegendKey> legend_of(const Scene& scene);

/// The same with the title of the labels, which is that of the last key with a title.
std::vector<LegendKey> legend_of(const Scene& scene, const Labels& labels);

/// A sentence on two entries of the legend that have different names and one colour, or nearly one, unless they are
/// categories of one attribute; empty: there are none.
std::string equal_colours(const Scene& scene);

/// A sentence on an attribute whose numbers are all unknown; empty: there is none. Costs a pass over all spheres that
/// are coloured by numbers.
std::string unknown_numbers(const Scene& scene);

/// Spheres that give the legend of all: the first of each entry, in any order.
std::vector<std::int64_t> spheres_of_legend(const Scene& scene);

/// A sentence on categories that share a colour because there are more of them than colours; empty: there are none.
std::string shared_colours(const Scene& scene);

/// The screen value of linear light under a transfer, 0 to 1.
Vec3d screen_colour(Vec3d linear, Transfer transfer);

}  // namespace bihive
