#include "bihive/viewer/scene_input.h"

#include <utility>

#include "bihive/image/colour_text.h"
#include "bihive/io/packed.h"
#include "bihive/scene/arrows.h"
#include "bihive/scene/bonds.h"
#include "bihive/scene/cavities.h"
#include "bihive/scene/contact_links.h"
#include "bihive/scene/element_colours.h"
#include "bihive/scene/floor.h"
#include "bihive/scene/hydrogen_bonds.h"
#include "bihive/scene/light_text.h"
#include "bihive/scene/look_text.h"
#include "bihive/scene/traces.h"
#include "bihive/select/attribute_names.h"

namespace bihive {
namespace {

constexpr const char* kNoBackground = "none";

Error look_error(const std::string& message, const std::string& hint) {
  return {message, "", 0, 0, hint};
}

Status recolour(Scene& scene, const std::string& scheme) {
  const std::optional<ElementColours> colours = element_colours_called(scheme);
  if (!colours) return look_error("there are no element colours \"" + scheme + "\"", "there are soft, jmol and cpk");
  return recolour_elements(scene, *colours);
}

// As the command line takes it: numbers are light, texts what the screen shows. `or_else`: for the hint.
Result<Vec3d> linear_colour(const char* of_what, const std::string& text, const Scene& scene,
                            const std::string& or_else) {
  const Result<ColourChoice> choice = colour_choice_from_text(text);
  if (!choice)
    return look_error(std::string(of_what) + ": " + choice.error().message,
                      choice.error().hint + (choice.error().hint.empty() ? "" : " ") + or_else);
  if (const auto* light = std::get_if<Vec3d>(&*choice)) return *light;
  return *colour_from_text(text, scene.picture.transfer);
}

Status set_background(Scene& scene, const std::string& background) {
  scene.picture.transparent = background == kNoBackground;
  if (scene.picture.transparent) return Done{};
  const Result<Vec3d> colour = linear_colour("background", background, scene, "or \"none\" for a transparent one");
  if (!colour) return colour.error();
  scene.background = *colour;
  return Done{};
}

// `kept`: the plane that it had in another frame.
Status lay_floor(LoadedScene& loaded, const ViewerLook& look, const std::optional<Plane>& kept) {
  Scene& scene = loaded.scene;
  const std::string& text = look.floor;
  if (scene.plane) return look_error("floor: the scene has a plane of its own", "leave the floor out");
  std::optional<Vec3d> colour;
  if (text != kFloorOfShadows) {
    const Result<Vec3d> given =
        linear_colour("floor", text, scene, "or \"" + kFloorOfShadows + "\" for its shadows alone");
    if (!given) return given.error();
    colour = *given;
  }
  const Vec3d up = look.floor_up ? *look.floor_up : loaded.has_camera ? scene.camera.up : Vec3d{0, 1, 0};
  scene.plane = floor_in(kept ? *kept : plane_below(scene, normalized(up)), colour, scene);
  return Done{};
}

Result<Look> look_of(const LookRow& row) {
  Result<LookAction> action = look_action_from_text(row.action, row.value);
  if (!action) return action.error();
  return Look{row.select.empty() ? "all" : row.select, {std::move(*action)}};
}

// Requested lights replace the style's or the scene's own.
Status light_up(LoadedScene& loaded, const std::vector<std::string>& lights) {
  LightChoice choice;
  for (const std::string& text : lights)
    if (Status status = add_light(text, choice); !status)
      return look_error("light: " + status.error().message, status.error().hint);
  if (choice.empty()) return Done{};
  loaded.rig = rig_of(choice, loaded.scene.ambient_light);
  loaded.scene.ambient_light = loaded.rig.ambient_light;
  loaded.has_lights = false;
  return Done{};
}

// Applied to all spheres before the rows.
Result<std::vector<Look>> looks_of_all(const ViewerLook& look) {
  std::vector<Look> looks;
  for (const auto& [action, value] : {std::pair("crease", look.crease), std::pair("colour-by", look.colour_by)}) {
    if (value.empty()) continue;
    Result<Look> one = look_of({"", action, value});
    if (!one) return look_error(std::string(action) + ": " + one.error().message, one.error().hint);
    looks.push_back(std::move(*one));
  }
  return looks;
}

// The user's colour of unknown numbers goes to all of the user's actions that colour by a number.
Status set_nan_colour(const std::string& text, std::vector<Look>& looks, std::size_t first) {
  if (text.empty()) return Done{};
  const Result<ColourChoice> colour = colour_choice_from_text(text);
  if (!colour) return look_error("colour of unknown numbers: " + colour.error().message, colour.error().hint);
  for (std::size_t i = first; i < looks.size(); ++i)
    for (LookAction& action : looks[i].actions)
      if (auto* const how = std::get_if<ColourBy>(&action)) how->nan_colour = *colour;
  return Done{};
}

// An open range is the one that the same colours had in another frame.
void keep_range(const std::vector<ColourBy>& ranges, ColourBy& how) {
  if (how.range) return;
  for (const ColourBy& one : ranges)
    if (one.range && one.attribute == how.attribute && one.logarithmic == how.logarithmic &&
        (!how.map || how.map == one.map))
      how.range = one.range;
}

}  // namespace

SceneInput::SceneInput(Kind kind, LoadedScene loaded) : kind_(kind), loaded_(std::move(loaded)) {
  facts_ = facts_of(loaded_);
  facts_.takes_style = kind != Kind::own;
  facts_.is_file_of_spheres = kind == Kind::spheres;
  facts_.attributes = attribute_names(loaded_.scene.spheres);
  facts_.time_ps = loaded_.time_ps;
  facts_.has_cell = loaded_.scene.spheres.cell().has_value();
  facts_.copies = loaded_.scene.spheres.images().counts;
  facts_.has_elements = !loaded_.scene.spheres.attributes().element.empty();
  if (loaded_.scene.picture.trails.any()) add_warning("the trails of this scene are not drawn here");
}

Result<SceneInput> SceneInput::built_in(const std::string& name, const ScenarioParameters& parameters,
                                        const ReadOptions& options) {
  Result<LoadedScene> loaded = built_in_scene(name, parameters, options);
  if (!loaded) return loaded.error();
  return SceneInput(name == "demo" ? Kind::spheres : Kind::own, std::move(*loaded));
}

Result<SceneInput> SceneInput::file(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  // The content counts, not the packing: a packed scene file has a look of its own too.
  if (is_packed(bytes)) {
    const Result<std::string> unpacked = unpack_if_packed(std::string(bytes), name);
    if (!unpacked) return unpacked.error();
    return file(*unpacked, name, options);
  }
  Result<LoadedScene> loaded = load_scene(bytes, name, options, LooksOfFile::keep);
  if (!loaded) return loaded.error();
  const bool document = looks_like_scene(bytes);
  SceneInput input(document ? Kind::document : Kind::spheres, std::move(*loaded));
  if (document) input.bytes_ = bytes;
  input.name_ = name;
  input.options_ = options;
  return input;
}

SceneInput SceneInput::spheres(SphereFile file, const std::string& name) {
  SceneInput input(Kind::spheres, scene_of_spheres(std::move(file), name));
  input.name_ = name;
  return input;
}

SceneInput SceneInput::made(Scene scene, SceneFacts facts, bool has_camera, bool has_lights) {
  LoadedScene loaded;
  loaded.scene = std::move(scene);
  loaded.has_camera = has_camera;
  loaded.has_lights = has_lights;
  loaded.format = facts.format;
  loaded.frames = facts.frames;
  loaded.rules = std::move(facts.rules);
  loaded.warnings = std::move(facts.warnings);
  SceneInput input(Kind::own, std::move(loaded));
  input.facts_.name = std::move(facts.name);
  input.facts_.spheres = facts.spheres;
  return input;
}

Status SceneInput::replicate(Scene& scene, const Copies& copies) {
  SphereSet& spheres = scene.spheres;
  if (!copies || *copies == spheres.images().counts) return Done{};
  if (!spheres.cell()) return look_error("there is no periodic cell to replicate by", "replicate: leave it out");
  return spheres.replicate(spheres.cell()->vectors, *copies);
}

Result<LoadedScene> SceneInput::in_style(const std::string& style, const Copies& copies,
                                         const std::vector<ColourBy>* ranges) const {
  // A scene file keeps its own appearance unless a style is given.
  if (kind_ == Kind::own || (kind_ == Kind::document && style.empty())) {
    if (kind_ == Kind::own && !style.empty())
      return look_error("this scene has a look of its own", "styles are for files");
    LoadedScene loaded = loaded_;
    if (Status status = replicate(loaded.scene, copies); !status) return status.error();
    return loaded;
  }
  Result<Style> named = style_named(style.empty() ? style_names().front() : style);
  if (!named) return named.error();
  if (kind_ == Kind::document) {
    Result<LoadedScene> loaded = load_scene(bytes_, name_, options_, LooksOfFile::keep, &*named);
    if (!loaded) return loaded.error();
    if (Status status = replicate(loaded->scene, copies); !status) return status.error();
    return loaded;
  }
  // Colours by position depend on the copies.
  LoadedScene loaded = loaded_;
  if (Status status = replicate(loaded.scene, copies); !status) return status.error();
  if (ranges != nullptr && named->colour_by) keep_range(*ranges, *named->colour_by);
  restyle(loaded, *named);
  return loaded;
}

// The scene file's own looks, then what is for all spheres, then the rows. All selections see the spheres as they were
// read.
Result<std::vector<std::int64_t>> SceneInput::do_looks(LoadedScene& loaded, const ViewerLook& look,
                                                       std::size_t* failed_row,
                                                       const std::vector<ColourBy>* ranges) const {
  std::vector<Look> looks = loaded.looks;
  const std::size_t own = looks.size();
  Result<std::vector<Look>> of_all = looks_of_all(look);
  if (!of_all) return of_all.error();
  looks.insert(looks.end(), of_all->begin(), of_all->end());
  const std::size_t first_row = looks.size();
  for (std::size_t row = 0; row < look.rows.size(); ++row) {
    Result<Look> next = look_of(look.rows[row]);
    if (!next) {
      if (failed_row != nullptr) *failed_row = row;
      return next.error();
    }
    looks.push_back(std::move(*next));
  }
  if (Status status = set_nan_colour(look.nan_colour, looks, own); !status) return status.error();
  for (Look& one : looks)
    for (LookAction& action : one.actions)
      if (auto* const how = std::get_if<ColourBy>(&action); how != nullptr && ranges != nullptr)
        keep_range(*ranges, *how);
  std::size_t failed = 0;
  Result<std::vector<std::int64_t>> counts = apply_looks(loaded.scene, looks, &failed);
  if (counts) return std::vector<std::int64_t>(counts->begin() + static_cast<std::ptrdiff_t>(first_row), counts->end());
  if (failed >= first_row) {
    if (failed_row != nullptr) *failed_row = failed - first_row;
    return counts.error();
  }
  const Error& error = counts.error();
  if (failed >= own) return error;
  const std::string place = error.column > 0 ? "/select: column " + std::to_string(error.column) : "";
  return Error{"/looks/" + std::to_string(failed) + place + ": " + error.message, name_, 0, 0, error.hint};
}

Result<SceneInput::Looked> SceneInput::looked_at(const ViewerLook& look, const Copies& copies, const Overrides& user,
                                                 std::size_t* failed_row, const KeptOfFrame& kept) const {
  if (failed_row != nullptr) *failed_row = look.rows.size();
  if (!look.style.empty())
    if (const Result<Style> known = style_named(look.style); !known) return known.error();
  Result<LoadedScene> loaded = in_style(look.style, copies, kept.ranges);
  if (!loaded) return loaded.error();
  Looked looked{std::move(*loaded), {}};
  Scene& scene = looked.loaded.scene;
  if (!look.background.empty())
    if (Status status = set_background(scene, look.background); !status) return status.error();
  if (Status status = light_up(looked.loaded, look.lights); !status) return status.error();
  if (!look.element_colours.empty())
    if (Status status = recolour(scene, look.element_colours); !status) return status.error();
  PictureSettings picture = scene.picture;  // the scene keeps its own
  user.apply_to(picture);
  std::optional<LinkTable> contacts;  // of the radii as read
  if (picture.links.shows_contacts()) {
    Result<LinkTable> found = contact_links(scene, picture.links.contact_probe);
    if (!found) return look_error("contacts: " + found.error().message, found.error().hint);
    contacts = std::move(*found);
  }
  const Sticks sticks = picture.sticks;
  if (sticks.bonds != Bonds::none)
    if (Status status = scale_balls(scene, sticks); !status)
      return look_error(status.error().message, "choose a style without bonds, or none");
  Result<std::vector<std::int64_t>> counts = do_looks(looked.loaded, look, failed_row, kept.ranges);
  if (!counts) return counts.error();
  if (sticks.bonds != Bonds::none)
    if (Status status = find_bonds(scene, sticks); !status) return status.error();
  if (picture.arrows.any())
    if (const Result<AddedArrows> added = add_arrows(scene, picture.arrows); !added) return added.error();
  if (picture.traces.any())
    if (const Result<AddedTraces> added = add_traces(scene, picture.traces); !added) return added.error();
  if (contacts)
    if (const Result<AddedLinks> added = add_links(scene, *contacts, picture.links); !added) return added.error();
  if (picture.hydrogen_bonds.any())
    if (const Result<std::int64_t> added = add_hydrogen_bonds(scene, picture.hydrogen_bonds); !added)
      return added.error();
  if (scene.picture.shows_cavities())
    if (const Result<ShownCavities> shown = show_cavities(scene, scene.picture.cavity_probe); !shown)
      return shown.error();
  looked.counts = std::move(*counts);
  if (!look.floor.empty())
    if (Status status = lay_floor(looked.loaded, look, kept.floor); !status) return status.error();
  return looked;
}

}  // namespace bihive
