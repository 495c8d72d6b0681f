#include "bihive/job/choose_sticks.h"

#include <fmt/format.h>

#include <initializer_list>
#include <iterator>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "bihive/base/setting_name.h"
#include "bihive/base/write_file.h"
#include "bihive/io/frames.h"
#include "bihive/job/failure.h"
#include "bihive/job/frame_source.h"
#include "bihive/job/messages.h"
#include "bihive/scene/arrows.h"
#include "bihive/scene/bonds.h"
#include "bihive/scene/contact_links.h"
#include "bihive/scene/hydrogen_bonds.h"
#include "bihive/scene/links.h"
#include "bihive/scene/traces.h"
#include "bihive/scene/trails.h"
#include "bihive/settings/parameter.h"

namespace bihive {
namespace {

// ---- Settings of what is not there -----------------------------------------------------------------------------

// Settings whose ids begin so.
void refuse_settings(const PictureRequest& request, bool any, std::initializer_list<std::string_view> beginnings,
                     const std::string& what, const std::string& hint) {
  if (any) return;
  for (const std::string_view beginning : beginnings)
    for (const Parameter& row : picture_parameters())
      if (row.id.starts_with(beginning) && request.picture.has(row.id))
        fail_setting(std::string(row.id), " is for pictures with " + what + ", and this one has none", hint);
}

void refuse_distributed(const WholeSet* whole, bool any, const char* id, const std::string& fault,
                        const std::string& hint = "") {
  if (any && whole != nullptr)
    fail_setting(id, fault + " spheres that are distributed over ranks",
                 hint.empty() ? "leave " + setting_name(id) + " out" : hint);
}

// ---- Drawing ----------------------------------------------------------------------------------------------------

void done_or_fail_bonds(const Status& status) {
  if (!status)
    fail_setting("bonds", ": " + status.error().message,
                 status.error().hint.empty() ? "add " + setting_name("bonds") + " none" : status.error().hint);
}

template <class T>
const T& added_or_fail(const Result<T>& added) {
  if (!added) fail_usage(added.error().message, added.error().hint);
  return *added;
}

void draw_traces(const Traces& traces, Scene& scene) {
  const Result<AddedTraces> added = add_traces(scene, traces);
  if (added_or_fail(added).tubes == 0) warn("there is no tube: no two beads in a row are near each other");
}

// Pictures of one film would have different ranges.
void check_fixed_range(const char* setting, const std::string& text, const Scene& scene) {
  const Result<ColourBy> asked_for = colour_by_from_text(text);
  if (!asked_for || asked_for->range) return;
  for (const ColourBy& how : scene.sticks_coloured_by)
    if (how.attribute == asked_for->attribute && how.range)
      fail_setting(setting, " has another range in each picture of a film",
                   "add one: " + asked_for->attribute + ":" + "MIN,MAX");
}

void draw_arrows(const Arrows& arrows, bool is_of_film, Scene& scene) {
  if (is_of_film && arrows.share > 0)
    fail_setting("arrow_share", " has another scale in each picture of a film", "give " + setting_name("arrow_scale"));
  const Result<AddedArrows> done = add_arrows(scene, arrows);
  const AddedArrows& added = added_or_fail(done);
  if (is_of_film) check_fixed_range("arrow_colour", arrows.colour, scene);
  if (is_of_film) return;
  if (added.count == 0)
    warn("no sphere has an arrow: " +
         std::string(added.unknown > 0 ? "their vectors are unknown" : "all vectors are 0"));
  else if (added.unknown > 0)
    warn(fmt::format("{} sphere{} no arrow: the vector is unknown", added.unknown,
                     added.unknown == 1 ? " has" : "s have"));
  if (added.count > 0 && added.inside == added.count)
    warn(
        fmt::format("all arrows end inside their spheres, the longest {:.3g} from its tail in one of radius {:.3g}: "
                    "{} F makes them longer",
                    added.longest, added.radius_of_longest, setting_name("arrow_scale")));
}

// `no_rows`: why there may be no link.
void draw_links(const LinkTable& table, const Links& links, const std::string& no_rows, bool is_of_film, Scene& scene) {
  const Result<AddedLinks> done = add_links(scene, table, links);
  const AddedLinks& added = added_or_fail(done);
  if (is_of_film) return check_fixed_range("link_colour", links.colour, scene);
  if (added.count == 0)
    warn("there is no link: " + std::string(table.pairs.empty() ? no_rows
                                            : added.unknown > 0 ? "their radii are unknown"
                                                                : "radii are 0, or a sphere of each is hidden"));
  else if (added.unknown > 0)
    warn(
        fmt::format("{} link{} not drawn: the radius is unknown", added.unknown, added.unknown == 1 ? " is" : "s are"));
}

void draw_trails(const Trails& trails, const PictureRequest& request, const FrameSource* frames, Input& input) {
  const bool is_of_film = frames != nullptr || request.fixed.has_value();
  if (request.input.input == kStandardStream)
    fail_setting("trail", " needs the frames before, and the standard input can be read once",
                 "write it into a file first");
  if (request.input.input.empty())
    fail_setting("trail", " needs the frames before, and these spheres are in memory",
                 "leave " + setting_name("trail") + " out");
  std::optional<FrameSource> opened;
  if (frames == nullptr) frames = &opened.emplace(FrameSource::open(request.input, Style(), false));
  const std::int64_t asked_for = request.input.reading.options().frame;
  const std::int64_t frame =
      numbered_frame(asked_for == 0 && !is_of_film ? input.stated_frame : asked_for, input.frames);
  const std::vector<std::shared_ptr<const SphereSet>> before = frames->before(frame, trails.frames);
  const Result<AddedTrails> done = add_trails(input.scene, before, trails);
  const AddedTrails& added = added_or_fail(done);
  if (added.other_count && !is_of_film)
    warn("frame " + std::to_string(frame - added.frames - 1) + " has another number of spheres: trails begin after it");
  if (is_of_film) return;
  if (before.empty())
    warn("there is no trail: there is no frame before frame " + std::to_string(frame));
  else if (added.sticks == 0 && added.frames > 0)
    warn("there is no trail: " + std::string(added.broken > 0 ? "each step leaves the cell" : "no sphere has moved"));
}

}  // namespace

ChosenSticks choose_sticks(const PictureRequest& request, const Scene& scene, const WholeSet* whole) {
  PictureSettings picture = scene.picture;
  request.picture.apply_to(picture);
  const Sticks& bonds = picture.sticks;
  const bool has_bonds = bonds.bonds != Bonds::none;
  refuse_settings(request, has_bonds, {"bond_", "stick_radius", "ball_scale"}, "bonds",
                  "add " + setting_name("bonds") + " auto");
  if (bonds.bonds == Bonds::file && request.picture.has("bond_reach"))
    fail_setting("bond_reach", " is for bonds by distance", "add " + setting_name("bonds") + " auto");
  if (bonds.bonds == Bonds::distance && bonds.orders && request.picture.has("bond_orders"))
    fail_setting("bond_orders", " is for bonds of the file", "add " + setting_name("bonds") + " auto");
  refuse_distributed(whole, has_bonds, "bonds", " are not found between", "add " + setting_name("bonds") + " none");

  const HydrogenBonds& hydrogen_bonds = picture.hydrogen_bonds;
  refuse_settings(request, hydrogen_bonds.any(), {"hbond_"}, "hydrogen bonds", "add " + setting_name("hbonds"));
  refuse_distributed(whole, hydrogen_bonds.any(), "hbonds", " are not found between");

  const Arrows& arrows = picture.arrows;
  refuse_settings(request, arrows.any(), {"arrow_"}, "arrows", "add " + setting_name("arrows") + " VX,VY,VZ");
  refuse_distributed(whole, arrows.any(), "arrows", " are not drawn on");

  const Traces& traces = picture.traces;
  refuse_settings(request, traces.any(), {"trace_"}, "tubes", "add " + setting_name("trace") + " chain");
  refuse_distributed(whole, traces.any(), "trace", ": no tubes are drawn through");

  const Trails& trails = picture.trails;
  refuse_settings(request, trails.any(), {"trail_"}, "trails", "add " + setting_name("trail") + " N");
  refuse_distributed(whole, trails.any(), "trail", ": no trails are drawn behind");

  const Links& links = picture.links;
  refuse_settings(request, links.shows_contacts() || !request.links.empty(), {"link_"}, "links",
                  "add " + setting_name("links") + " FILE or " + setting_name("show_contacts") + " R");
  refuse_distributed(whole, links.shows_contacts(), "show_contacts", ": no contacts are found between");
  return {bonds, hydrogen_bonds, arrows, traces, trails, links};
}

std::optional<LinkTable> find_contacts(const ChosenSticks& sticks, const Scene& scene, std::int64_t threads) {
  if (!sticks.links.shows_contacts()) return std::nullopt;
  Result<LinkTable> contacts = contact_links(scene, sticks.links.contact_probe, static_cast<int>(threads));
  if (!contacts) fail_setting("show_contacts", ": " + contacts.error().message, contacts.error().hint);
  return std::move(*contacts);
}

void scale_balls(const ChosenSticks& sticks, Scene& scene) {
  if (sticks.bonds.bonds != Bonds::none) done_or_fail_bonds(scale_balls(scene, sticks.bonds));
}

void draw_sticks(const ChosenSticks& sticks, const std::optional<LinkTable>& contacts, const PictureRequest& request,
                 const FrameSource* frames, Input& input) {
  Scene& scene = input.scene;
  const bool is_of_film = request.fixed.has_value();
  const int threads = static_cast<int>(request.threads);
  if (sticks.bonds.bonds != Bonds::none) {
    done_or_fail_bonds(find_bonds(scene, sticks.bonds, threads));
    if (scene.sticks.empty()) warn("no two atoms are near enough for a bond");
  }
  if (sticks.arrows.any()) draw_arrows(sticks.arrows, is_of_film, scene);
  if (sticks.traces.any()) draw_traces(sticks.traces, scene);
  if (!request.links.empty()) {
    const LinkTable table = value_or_fail(links_from_csv(value_or_fail(read_file(request.links)), request.links));
    draw_links(table, sticks.links, "the table has no rows", is_of_film, scene);
  }
  if (contacts) draw_links(*contacts, sticks.links, "no two spheres are in contact", is_of_film, scene);
  if (sticks.hydrogen_bonds.any()) {
    const Result<std::int64_t> added = add_hydrogen_bonds(scene, sticks.hydrogen_bonds, threads);
    if (added_or_fail(added) == 0 && !is_of_film) warn("there is no hydrogen bond");
  }
  if (sticks.trails.any()) draw_trails(sticks.trails, request, frames, input);
}

}  // namespace bihive
