// The user's appearance of the spheres: the equivalent of --style, --element-colours, --background, --light,
// --colour-by, --nan-colour, --crease, --floor and --select with the options after it of `bihive render`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bihive/math/vec3.h"
#include "bihive/scene/look_text.h"

namespace bihive {

/// Plain data; viewer/viewer_json.h turns it into JSON, for links and saved states.
struct ViewerLook {
  std::string style;                  ///< one of style_names(); empty: the default of `bihive render`
  std::string element_colours;        ///< "soft", "jmol" or "cpk"; empty: the style's
  std::string background;             ///< a colour, or "none": transparent; empty: the style's
  std::vector<LookRow> rows;          ///< applied in order, after the looks of a scene file and those below
  std::vector<std::string> lights{};  ///< as scene/light_text.h; empty: the style's, or the scene's own
  std::string colour_by{};   ///< of all spheres, as colour_by_from_text() takes it; empty: the style's or the scene's
  std::string nan_colour{};  ///< a colour, for colour_by and for all rows; empty: grey
  std::string crease{};      ///< an attribute: lines between spheres that differ in it; empty: the style's
  std::string floor{};       ///< a colour, or kFloorOfShadows (scene/floor.h); empty: none but the scene's own
  std::optional<Vec3d> floor_up{};  ///< normal of the floor, of any length but 0; null: up of the file's camera, or y

  friend bool operator==(const ViewerLook& a, const ViewerLook& b) {
    return a.style == b.style && a.element_colours == b.element_colours && a.background == b.background &&
           a.lights == b.lights && a.colour_by == b.colour_by && a.nan_colour == b.nan_colour && a.crease == b.crease &&
           a.floor == b.floor && a.floor_up == b.floor_up && a.rows == b.rows;
  }
  friend bool operator!=(const ViewerLook& a, const ViewerLook& b) { return !(a == b); }
};

}  // namespace bihive
