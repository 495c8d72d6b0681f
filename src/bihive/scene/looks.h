// Appearance of selected spheres: hidden, coloured, clearer, smaller, of another material, outlined, cut open. The
// options of `bihive render` after --select, and the key `looks` of scene files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/geometry/clip.h"
#include "bihive/scene/colour_by.h"
#include "bihive/scene/scene.h"

namespace bihive {

struct SetShown {
  bool shown;  ///< false: absent for every ray
};
struct SetColour {
  ColourChoice colour;  ///< replaces the material's colour
};
struct SetOpacity {
  double opacity;  ///< 0 (clear) to 1; replaces the file's
};
struct SetMaterial {
  Material material;  ///< its colour is not used: spheres keep theirs
};
struct ScaleRadius {
  double factor;  ///< >= 0
};
struct SetOutline {
  double width_px;  ///< 0 (none), or 1 to kWidestOutlinePx; replaces the picture's
};
/// Lines between those of the spheres that differ in the attribute, and between them and all others.
struct SetCrease {
  std::string attribute;  ///< a name as selections know it
};
/// The name of the spheres' colour in the legend. If the same look colours them by an attribute, the title of its key.
/// Applied after the look's other actions.
struct SetLegendName {
  std::string name;  ///< UTF-8, not empty
};
/// One more clip that acts on the spheres.
struct AddClip {
  Clip clip;
};
/// Values for each sphere of the scene, for programs that have arrays of them. Those of spheres that are not selected
/// are not used. An Error if their number is another one.
struct SetColours {
  std::vector<Vec3d> colours;
  bool are_light;  ///< linear; false: as the screen shows them, as "srgb(r,g,b)"
};
struct SetOpacities {
  std::vector<double> opacities;  ///< 0 (clear) to 1
};
/// Factors of earlier actions no longer count, those of later ones do.
struct SetRadii {
  std::vector<double> radii;  ///< >= 0, world units
};
/// One action on spheres. To add a kind: a struct here, and its case in looks.cpp.
using LookAction = std::variant<SetShown, SetColour, ColourBy, SetOpacity, SetMaterial, ScaleRadius, SetOutline,
                                SetCrease, SetLegendName, AddClip, SetColours, SetOpacities, SetRadii>;

/// Actions on the spheres of one selection, done in their order.
struct Look {
  std::string select = "all";  ///< docs/selections.md
  std::vector<LookAction> actions;
};

/// Applies all actions in their order; a later one replaces an earlier one, except that factors multiply and clips add
/// up. Every selection sees the spheres as they were before: hidden ones too, with their first radii and opacities.
/// Afterwards hidden spheres are removed from the set; Scene::id_in_input knows the ids of the rest, and materials and
/// attributes keep in step. Radii are rounded once.
///
/// Returns how many spheres each look selects. Errors: a selection's (column and line as in select_spheres()), an
/// action's, or that every sphere is hidden or cut away. The scene is then as it was, and `failed` (if given) is the
/// look's position; looks.size() if none is to blame. `failed_action` (if given) is the position of its action; the
/// number of its actions if the selection is to blame.
Result<std::vector<std::int64_t>> apply_looks(Scene& scene, const std::vector<Look>& looks,
                                              std::size_t* failed = nullptr, std::size_t* failed_action = nullptr);

}  // namespace bihive
