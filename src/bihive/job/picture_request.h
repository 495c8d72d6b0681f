// A request for a picture: its input and everything that a user has set, before any file is read. Command line, window,
// Python and C fill it by the table of options (job/picture_options.h); job/prepare_picture.h makes a scene of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bihive/geometry/plane.h"
#include "bihive/image/film.h"
#include "bihive/job/engine.h"
#include "bihive/job/input.h"
#include "bihive/job/look_options.h"
#include "bihive/job/rigid_motion.h"
#include "bihive/job/values.h"
#include "bihive/math/vec3.h"
#include "bihive/scene/camera.h"
#include "bihive/scene/framing.h"
#include "bihive/scene/light_text.h"
#include "bihive/scene/turn.h"
#include "bihive/settings/overrides.h"

namespace bihive {

/// The style of files and the lights.
struct StyleOptions {
  std::string name;                        ///< a name or a path; empty: the default one
  LightChoice lights;                      ///< empty: the style's
  std::vector<std::string> light_words{};  ///< the same, as given
};

/// Options of labels that are not parameters of a picture.
struct LabelOptions {
  bool none = false;              ///< leave out those of the scene and its style
  std::string title_values = "";  ///< a CSV file with a row for each frame; empty: none
  std::string font = "";          ///< the file of a font; empty: DejaVu Sans
};

/// Values fixed for all pictures of a film.
struct FixedByFilm {
  Camera camera;  ///< of this picture
  ColourRange range_of_style;
  std::vector<ColourRange> ranges_of_looks;
  std::optional<RigidMotion> motion{};  ///< of all spheres, before looks
  std::optional<Plane> floor{};         ///< of `floor`
  std::optional<Density> density{};     ///< of the style
  bool fits_each = false;               ///< the camera is that of the spheres, in place of `camera`
};

/// The value of `background` for a transparent picture.
inline const std::string kNoBackground = "none";

/// An option as given: "light_points" and "12".
struct GivenSetting {
  std::string id, value;
};

/// A direction of view that depends on the spheres.
struct ViewOfSpheres {
  std::string best_of;  ///< the direction that shows most of this selection; empty: along the shortest principal axis
};

/// Unset: the scene's value.
struct PictureRequest {
  InputOptions input;
  LookOptions looks;
  Overrides picture;         ///< parameters of settings/parameter.h
  std::optional<Tile> crop;  ///< not yet checked against the size
  View view = View::shaded;
  RenderEngine engine = RenderEngine::automatic;
  TreeParameters tree;
  bool tune = false;         ///< search `tree` (job/tuned_tree.h)
  std::int64_t threads = 0;  ///< 0 = as many as the machine runs at once
  StyleOptions style;
  LabelOptions labels;
  std::string links;                      ///< a CSV file of them (scene/links.h); empty: none
  std::optional<std::string> background;  ///< a valid colour, whose meaning depends on the transfer, or kNoBackground
  std::optional<std::string> floor;       ///< a valid colour, or kFloorOfShadows (job/floor.h)
  std::optional<std::int64_t> bits;       ///< 8 or 16
  double dots_per_inch = 0;               ///< 0: not stated
  std::optional<PrintSize> print_size;    ///< with `dots_per_inch` the size in `picture`
  std::optional<Vec3d> eye, up;
  std::optional<LookAt> look_at;       ///< a point, or a selection: the centre of its bounds
  std::optional<std::string> fit;      ///< a selection that the camera frames in place of the whole set
  std::optional<std::string> zoom_to;  ///< a selection that the picture magnifies
  std::optional<double> fov_deg;
  std::optional<ViewFrom> view_from;
  std::optional<ViewOfSpheres> view_of;  ///< in place of view_from
  std::optional<Projection> projection;
  std::optional<Turn> turn;
  std::optional<double> zoom;      ///< above 0
  std::optional<double> aperture;  ///< world units, at least 0
  std::optional<Focus> focus;      ///< world units, 0: the camera's target; or the spheres in focus
  std::optional<FixedByFilm> fixed;
  std::vector<GivenSetting> given;  ///< all options; repeatable ones in their order
};

}  // namespace bihive
