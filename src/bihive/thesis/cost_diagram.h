// The diagram of Figure 4.4: the costs at which each tree wins. For `bihive thesis` and for the page.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bihive/thesis/cost_model.h"

namespace bihive {

/// A measured engine.
struct CostPoint {
  std::string name;
  FittedCosts fitted;
};

struct CostDiagram {
  std::string title, pattern_label, share_label;  ///< of the picture and of its legend
  std::vector<double> inner;                      ///< one per column, ascending, evenly spaced on a logarithmic axis
  std::vector<double> leaf;                       ///< one per row, ascending, evenly spaced
  /// Row by row: the configurations that the tree wins; whether the whole pattern holds; the share of the seeds with
  /// which it does (empty without other seeds).
  std::vector<int> wins;
  std::vector<bool> pattern;
  std::vector<double> share;
  int most_wins = 9;
  std::vector<CostPoint> points = {};  ///< those outside the axes are drawn at the edge, with their numbers
};

/// The diagram without points: an inner node from 1/4 to 16 sphere tests, a leaf from 0 to 1 inner node. `seeds`: the
/// same work with other seeds, for the share that has the pattern.
CostDiagram cost_diagram(const FigureWork& work, const WinPattern& pattern, const std::vector<FigureWork>& seeds);

/// An SVG text: colours for wins, an outline around the pattern, a dashed one where half of the seeds have it, and a
/// point with error bars for each engine.
std::string cost_diagram_svg(const CostDiagram& diagram);
std::string_view cost_diagram_style();  ///< its CSS: thesis/figure-4.4/costs.css
std::string_view
cost_diagram_template();  ///< its title, axes and legend, fields in braces: thesis/figure-4.4/costs.svg

/// A line for each cell: inner_node_per_sphere_test,leaf_per_inner_node,wins,pattern,share_of_seeds.
std::string cost_diagram_csv(const CostDiagram& diagram);

}  // namespace bihive
