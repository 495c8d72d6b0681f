#include "bihive/job/picture_options.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "bihive/base/near_name.h"
#include "bihive/base/parse_number.h"
#include "bihive/base/setting_name.h"
#include "bihive/job/failure.h"
#include "bihive/job/report_text.h"
#include "bihive/job/selection.h"
#include "bihive/scene/colour_by.h"
#include "bihive/scene/element_colours.h"
#include "bihive/scene/floor.h"
#include "bihive/scene/look_text.h"
#include "bihive/scene/named_materials.h"
#include "bihive/scene/style.h"
#include "bihive/select/selection.h"
#include "bihive/settings/parameter_text.h"

namespace bihive {
namespace {

using Row = RequestOption<PictureRequest>;
using Rows = std::vector<Row>;
using Take = decltype(Row::take);
constexpr ParameterRanks kChunks = ParameterRanks::chunks, kWhole = ParameterRanks::whole;

constexpr double kLargestFloat = 3.4028234663852886e38;
constexpr double kMostZoom = 1e6;
constexpr double kMostDotsPerInch = 1e6;
constexpr const char* kTwice = "is given more than once before a select";

// The parsed text becomes the value of a member.
template <class Request, class Owner, class Member, class Parse>
auto into(Member Owner::*member, Parse parse) {
  return [member, parse](Request& request, const std::string& text) -> Status {
    auto value = parse(text);
    if (!value) return value.error();
    request.*member = *std::move(value);
    return Done{};
  };
}
template <class Member, class Parse>
Take into(Member PictureRequest::*member, Parse parse) {
  return into<PictureRequest, PictureRequest>(member, parse);
}

template <class T>
std::string joined_names(const Names<T>& names) {
  std::string list;
  for (const auto& [name, value] : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

template <class T>
auto choice(const Names<T>& names) {
  return [&names](const std::string& text) { return choice_from(text, names); };
}

// A colour, or this word.
auto colour_or(const std::string& word) {
  return [word](const std::string& text) -> Result<std::string> {
    if (text == word) return text;
    const Result<Vec3d> colour = colour_from(text, Transfer::none);
    if (!colour) return colour.error();
    return text;
  };
}

// A row for a member of a request, as a row for the request.
template <class Part>
Row of_part(const RequestOption<Part>& row, Part PictureRequest::*part) {
  return {
      .id = row.id,
      .value_name = row.value_name,
      .help = row.help,
      .theme = row.theme,
      .ranks = row.ranks,
      .in_window = row.in_window,
      .in_page = row.in_page,
      .repeatable = row.repeatable,
      .excludes = row.excludes,
      .take = [&row, part](PictureRequest& request, const std::string& text) { return row.take(request.*part, text); }};
}

std::string with_usual(const Parameter& parameter) {
  std::string help(parameter.help);
  if (!parameter.usual.empty()) help += " (" + std::string(parameter.usual) + ")";
  if (!parameter.implies.empty() && parameter_named(parameter.implies)->has_option)
    help += "; implies " + option_of(*parameter_named(parameter.implies));
  return help;
}

// "light_points" for the parameter with that id, and "no_..." if there is one.
void add_parameter(Rows& rows, const Parameter& parameter, OptionTheme theme) {
  const std::string id = setting_of_option(option_of(parameter));
  Row row{.id = id,
          .value_name = std::string(parameter.names.empty() ? parameter.value_name : parameter.names),
          .help = with_usual(parameter),
          .theme = theme,
          .ranks = parameter.ranks,
          .in_window = parameter.in_window};
  if (parameter.kind != ParameterKind::flag) {
    row.take = [&parameter](PictureRequest& request, const std::string& text) -> Status {
      Result<SettingValue> value = value_from_text(parameter, text);
      if (!value) return value.error();
      request.picture.set(parameter.id, std::move(*value));
      return Done{};
    };
    rows.push_back(std::move(row));
    return;
  }
  const auto set = [&parameter](bool on) {
    return [&parameter, on](PictureRequest& request, const std::string&) -> Status {
      request.picture.set(parameter.id, on);
      return Done{};
    };
  };
  row.value_name.clear();
  row.take = set(true);
  rows.push_back(row);
  if (!parameter.has_no_option) return;
  Row off = row;
  off.id = "no_" + id;
  off.help = "Switches " + option_of(parameter) + " off";
  off.take = set(false);
  off.excludes = {id};
  // An option that implies a switch excludes the one that turns it off.
  for (const Parameter& other : picture_parameters())
    if (other.implies == parameter.id) off.excludes.push_back(setting_of_option(option_of(other)));
  rows.push_back(std::move(off));
}

void add_parameters(Rows& rows, ParameterGroup group, OptionTheme theme) {
  for (const Parameter& parameter : picture_parameters())
    if (parameter.group == group && parameter.has_option) add_parameter(rows, parameter, theme);
}

Done set_size(PictureRequest& request, PictureSize size) {
  request.picture.set("width_px", size.width_px);
  request.picture.set("height_px", size.height_px);
  return {};
}

// Size and pixels per inch may come in any order.
Status set_print_size(PictureRequest& request) {
  if (!request.print_size || request.dots_per_inch == 0) return Done{};
  const Result<PictureSize> size = size_of_print(*request.print_size, request.dots_per_inch);
  return size ? Status(set_size(request, *size)) : Status(size.error());
}

void add_picture(Rows& rows) {
  rows.insert(
      rows.end(),
      {{.id = "size",
        .value_name = "WxH",
        .help = "Pixels (1280x720), or with pixels per inch a size in print: 8.5x6cm; cm, mm, in, pt",
        .ranks = kChunks,
        .take = [](PictureRequest& request, const std::string& text) -> Status {
          const auto size = size_or_print_size_from(text);
          if (!size) return size.error();
          if (const PictureSize* const pixels = std::get_if<PictureSize>(&*size)) return set_size(request, *pixels);
          request.print_size = std::get<PrintSize>(*size);
          return set_print_size(request);
        }},
       {.id = "crop",
        .value_name = "X0,Y0,X1,Y1",
        .help = "Draw only this rectangle of its pixels, counted from the top left corner;\nX1, Y1 are exclusive",
        .ranks = kChunks,
        .in_window = false,
        .take = into(&PictureRequest::crop, crop_from)},
       {.id = "view",
        .value_name = list_of(kViews),
        .help = "Quantity to draw (shaded)",
        .ranks = kChunks,
        .take = into(&PictureRequest::view, choice(kViews))},
       samples_option(kMostSamplesPerPixel)});
  add_parameters(rows, ParameterGroup::picture, OptionTheme::picture);
  rows.insert(rows.end(), {{.id = "background",
                            .value_name = "COLOUR",
                            .help = "A name, #rrggbb, r,g,b from 0 to 1, or none: transparent (files: white)",
                            .ranks = kChunks,
                            .take = into(&PictureRequest::background, colour_or(kNoBackground))},
                           {.id = "floor",
                            .value_name = "COLOUR|shadow",
                            .help = "A plane below the spheres: in a colour, or seen by the shadows on it alone",
                            .theme = OptionTheme::style,
                            .ranks = kWhole,
                            .take = into(&PictureRequest::floor, colour_or(kFloorOfShadows))},
                           {.id = "bits",
                            .value_name = "8|16",
                            .help = "Bits of each number in the picture (8)",
                            .ranks = kChunks,
                            .in_window = false,
                            .take = into(&PictureRequest::bits, bits_from)},
                           {.id = "dpi",
                            .value_name = "N",
                            .help = "Pixels per inch in print: for letters, lines in points, and a note in the file",
                            .ranks = kChunks,
                            .in_window = false,
                            .take = [](PictureRequest& request, const std::string& text) -> Status {
                              const Result<double> dots = number_from_text(text, 0, kMostDotsPerInch, /*open=*/true);
                              if (!dots) return dots.error();
                              request.dots_per_inch = *dots;
                              return set_print_size(request);
                            }}});
}

void add_style(Rows& rows) {
  constexpr OptionTheme kTheme = OptionTheme::style;
  rows.insert(rows.end(), {{.id = "style",
                            .value_name = "NAME|FILE",
                            .help = "The style: see bihive styles (files: default)",
                            .theme = kTheme,
                            .ranks = kChunks,
                            .take = [](PictureRequest& request, const std::string& text) -> Status {
                              request.style.name = text;
                              return Done{};
                            }},
                           {.id = "light",
                            .value_name = "PRESET|SPEC",
                            .help = "The lights (the style's or the scene's): " + list_of(light_presets()) +
                                    ",\nfrom:RIGHT,UP,TOWARDS[:COLOUR[:STRENGTH[:DEG]]] around the camera, or\n"
                                    "at:X,Y,Z[:COLOUR[:STRENGTH[:RADIUS]]] in the world; repeatable",
                            .theme = kTheme,
                            .ranks = kChunks,
                            .repeatable = true,
                            .take = [](PictureRequest& request, const std::string& text) {
                              request.style.light_words.push_back(text);
                              return add_light(text, request.style.lights);
                            }}});
  for (const ParameterGroup group : {ParameterGroup::light, ParameterGroup::lines, ParameterGroup::tone})
    add_parameters(rows, group, kTheme);
}

// Fails with the faulty column of an expression that is none.
Status set_selection(const std::string& id, std::optional<std::string>& selection, const std::string& text) {
  if (const Status status = check_selection(text); !status) fail_selection(id, text, status.error());
  selection = text;
  return Done{};
}

// A side, "principal", or "best:" and a selection.
Status set_view(PictureRequest& request, const std::string& text) {
  constexpr std::string_view kBest = "best:";
  if (text == "principal") {
    request.view_of = ViewOfSpheres{};
    return Done{};
  }
  if (text.starts_with(kBest)) {
    const std::string selection = text.substr(kBest.size());
    if (const Status status = check_selection(selection); !status)
      fail_selection("view_from", selection, status.error());
    request.view_of = ViewOfSpheres{selection};
    return Done{};
  }
  const ViewFrom* const side = value_named(kSides, text);
  if (side == nullptr)
    return unexpected("one of " + joined_names(kSides) + ", principal or best:EXPR", text,
                      text == "best" ? "name the spheres: best:'chain A'" : "");
  request.view_from = *side;
  return Done{};
}

void add_camera(Rows& rows) {
  constexpr OptionTheme kTheme = OptionTheme::camera;
  rows.insert(
      rows.end(),
      {{.id = "view_from",
        .value_name = list_of(kSides) + "|principal|best:EXPR",
        .help = "Show the whole set from this side (files: front); principal: its longest axis along the\n"
                "picture's longer side; best: the direction that shows most of a selection",
        .theme = kTheme,
        .ranks = kChunks,
        .excludes = {"eye", "look_at"},
        .take = set_view},
       {.id = "eye",
        .value_name = "X,Y,Z",
        .help = "Camera position",
        .theme = kTheme,
        .ranks = kChunks,
        .take = into(&PictureRequest::eye, vector_from)},
       {.id = "look_at",
        .value_name = "X,Y,Z|EXPR",
        .help = "The middle of the picture: a point, or the centre of the spheres of a selection; the eye stays",
        .theme = kTheme,
        .ranks = kChunks,
        .take = into(&PictureRequest::look_at, look_at_from)},
       {.id = "fit",
        .value_name = "EXPR",
        .help = "These spheres alone are fitted into the picture, as if there were no others: the camera goes\n"
                "near them, and others may be beside or behind it",
        .theme = kTheme,
        .ranks = kWhole,
        .excludes = {"eye", "look_at", "zoom_to"},
        .take = [](PictureRequest& request,
                   const std::string& text) { return set_selection("fit", request.fit, text); }},
       {.id = "zoom_to",
        .value_name = "EXPR",
        .help = "Magnify until these spheres fill the picture: the camera keeps its direction and distance,\n"
                "and shows what stands before them",
        .theme = kTheme,
        .ranks = kWhole,
        .excludes = {"eye", "look_at"},
        .take = [](PictureRequest& request,
                   const std::string& text) { return set_selection("zoom_to", request.zoom_to, text); }},
       {.id = "up",
        .value_name = "X,Y,Z",
        .help = "The direction that is up in the picture",
        .theme = kTheme,
        .ranks = kChunks,
        .take = into(&PictureRequest::up, vector_from)},
       {.id = "fov",
        .value_name = "DEG",
        .help = "Angle along the shorter side (30; less in pictures over twice as wide as high)",
        .theme = kTheme,
        .ranks = kChunks,
        .take = into(&PictureRequest::fov_deg,
                     [](const std::string& text) { return number_from_text(text, 0, 180, /*open=*/true); })},
       {.id = "projection",
        .value_name = list_of(kProjections),
        .help = "orthographic: equal spheres look equally large at any distance (perspective)",
        .theme = kTheme,
        .ranks = kChunks,
        .take = into(&PictureRequest::projection, choice(kProjections))},
       {.id = "turn",
        .value_name = "AZ,EL[,ROLL]",
        .help = "Degrees: the camera moves AZ to the right and EL up around its target;\n"
                "the picture turns ROLL counter-clockwise",
        .theme = kTheme,
        .ranks = kChunks,
        .take = into(&PictureRequest::turn, turn_from)},
       {.id = "zoom",
        .value_name = "F",
        .help = "Magnify everything F times (1)",
        .theme = kTheme,
        .ranks = kChunks,
        .take = into(&PictureRequest::zoom,
                     [](const std::string& text) { return number_from_text(text, 0, kMostZoom, /*open=*/true); })},
       {.id = "aperture",
        .value_name = "R",
        .help = "Depth of field: the radius of the lens, in world units; 0: everything is sharp (0)",
        .theme = kTheme,
        .ranks = kChunks,
        .take = into(&PictureRequest::aperture,
                     [](const std::string& text) { return number_from_text(text, 0, kLargestFloat); })},
       {.id = "focus",
        .value_name = "D|auto|EXPR",
        .help = "With an aperture: the distance that is sharp, in world units, or the spheres that are,\n"
                "such as 'resname LIG' or 'index 12' (auto: the camera's target)",
        .theme = kTheme,
        .ranks = kChunks,
        .take = into(&PictureRequest::focus, focus_from)}});
}

void add_engine(Rows& rows) {
  rows.push_back(
      {.id = "engine",
       .value_name = list_of(kRenderEngines),
       .help = "The engine (auto): those of the CPU give the same bits, a graphics processor nearly the same",
       .theme = OptionTheme::engine,
       .ranks = kChunks,
       .take = into(&PictureRequest::engine, choice(kRenderEngines))});
  for (const RequestOption<TreeParameters>& row : tree_options()) rows.push_back(of_part(row, &PictureRequest::tree));
  rows.push_back({.id = "tune",
                  .help =
                      "Search the tree's limits that suit these spheres, in about ten seconds, as bihive tune does;\n"
                      "pictures keep their bits",
                  .theme = OptionTheme::engine,
                  .in_page = false,
                  .excludes = {"max_prims", "max_depth"},
                  .take = [](PictureRequest& request, const std::string&) -> Status {
                    request.tune = true;
                    return Done{};
                  }});
  rows.push_back({.id = "threads",
                  .value_name = "N",
                  .help = "Threads (0: as many as the machine runs at once)",
                  .theme = OptionTheme::engine,
                  .ranks = kChunks,
                  .in_window = false,
                  .take = into(&PictureRequest::threads,
                               [](const std::string& text) { return whole_number_from_text(text, 0, kMostThreads); })});
}

// An action on the spheres of the last `select`, or on all. `of_all`: the option's meaning before any `select`.
Row action(const std::string& id, const std::string& value_name, const std::string& help, Take of_all = {}) {
  return {.id = id,
          .value_name = value_name,
          .help = help,
          .theme = OptionTheme::spheres,
          .ranks = kWhole,
          .repeatable = true,
          .take = [id, of_all](PictureRequest& request, const std::string& text) -> Status {
            if (of_all && !request.looks.selected) return of_all(request, text);
            return request.looks.act(option_of_setting(id).substr(2), text);
          }};
}

std::string joined(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

// A switch among the actions.
template <class Act>
Row action_switch(const std::string& id, const std::string& help, Act act) {
  return {.id = id,
          .help = help,
          .theme = OptionTheme::spheres,
          .ranks = kWhole,
          .repeatable = true,
          .take = [act](PictureRequest& request, const std::string&) -> Status { return act(request.looks), Done{}; }};
}

void add_spheres(Rows& rows) {
  const Take scale_all = [](PictureRequest& request, const std::string& text) -> Status {
    if (request.input.reading.has("radius_scale")) return Error{kTwice, "", 0, 0, ""};
    return request.input.reading.take("radius_scale", text);
  };
  const Take outline_all = [](PictureRequest& request, const std::string& text) -> Status {
    const Result<LookAction> width = look_action_from_text("outline", text);
    if (!width) return width.error();
    if (request.picture.has("outline_px")) return Error{kTwice, "", 0, 0, ""};
    request.picture.set("outline_px", std::get<SetOutline>(*width).width_px);
    return Done{};
  };
  Row select =
      action("select", "EXPR", "The options after it apply to these spheres alone (docs/selections.md); repeatable");
  select.take = [](PictureRequest& request, const std::string& text) -> Status {
    return request.looks.select(text), Done{};
  };
  rows.insert(
      rows.end(),
      {std::move(select),
       action_switch("hide", "Hide them from every ray", [](LookOptions& looks) { looks.show(false); }),
       action_switch("show", "Show them again", [](LookOptions& looks) { looks.show(true); }),
       action("colour", "COLOUR", "Colour them: a name, #rrggbb or r,g,b from 0 to 1"),
       action("colour_by", "ATTR[:MAP][:MIN,MAX][:log][:mid=M]",
              "Colour them by an attribute or an expression of some; MIN,MAX also 2%,98%. MAP, or MAP_r reversed:\n" +
                  joined(colour_map_names()) + ",\ncolours such as blue-white-red, or a file of some")});
  Row nan_colour =
      action("nan_colour", "COLOUR", "Colour of unknown numbers in the attribute that gives colours (grey)");
  nan_colour.take = [](PictureRequest& request, const std::string& text) { return request.looks.set_nan_colour(text); };
  rows.push_back(std::move(nan_colour));
  rows.insert(
      rows.end(),
      {action("opacity", "F", "Their opacity, 0 (clear) to 1"),
       action("material", list_of(named_materials()), "Their material (the style's)"),
       action("radius_scale", "F", "After a selection: multiply their radii. Before: files, every radius", scale_all),
       action("outline", "PX",
              "After a selection: width of their outlines, 1 to 16; 0: none. Before: of all (the style's)",
              outline_all),
       action("crease", "ATTR", "Lines between those that touch and differ in it, such as chain"),
       action("legend_name", "TEXT",
              "Name them in the legend: beside their colour, or above the key of their colour-by"),
       action("clip", "plane:NX,NY,NZ,D|box:X0,Y0,Z0,X1,Y1,Z1|sphere:X,Y,Z,R",
              "Cut them open: n.x > D, the box or the sphere is removed; repeatable"),
       {.id = "element_colours",
        .value_name = "soft|jmol|cpk|FILE",
        .help = "Colours of elements: a name, or a file with lines 'C #909090' (the style's)",
        .theme = OptionTheme::spheres,
        .ranks = kWhole,
        .take = [](PictureRequest& request, const std::string& text) -> Status {
          request.looks.element_colours = text;
          return Done{};
        }},
       action_switch("no_hydrogens", "Hide hydrogen",
                     [](LookOptions& looks) { looks.hide_word("no_hydrogens", "hydrogen"); }),
       action_switch("no_water", "Hide water", [](LookOptions& looks) { looks.hide_word("no_water", "water"); })});
  // Both also apply to all spheres, which ranks then know without their ids.
  for (Row& row : rows)
    if (row.id == "outline" || (row.id == "radius_scale" && reading_setting("radius_scale")->with_chunks))
      row.ranks = kChunks;
}

void add_labels(Rows& rows) {
  constexpr OptionTheme kTheme = OptionTheme::labels;
  add_parameters(rows, ParameterGroup::cell, kTheme);
  add_parameters(rows, ParameterGroup::labels, kTheme);
  rows.insert(rows.end(), {{.id = "title_values",
                            .value_name = "FILE",
                            .help = "CSV: a row for each frame, from 0; the first line names the columns: {NAME}",
                            .theme = kTheme,
                            .ranks = kChunks,
                            .in_window = false,
                            .take = [](PictureRequest& request, const std::string& text) -> Status {
                              request.labels.title_values = text;
                              return Done{};
                            }},
                           {.id = "font",
                            .value_name = "FILE",
                            .help = "Font of titles, legends and the rest: TrueType or OpenType (DejaVu Sans)",
                            .theme = kTheme,
                            .ranks = kChunks,
                            .in_window = false,
                            .take = [](PictureRequest& request, const std::string& text) -> Status {
                              request.labels.font = text;
                              return Done{};
                            }},
                           {.id = "no_labels",
                            .help = "None of the labels that the scene file or the style asks for",
                            .theme = kTheme,
                            .ranks = kChunks,
                            .take = [](PictureRequest& request, const std::string&) -> Status {
                              request.labels.none = true;
                              return Done{};
                            }}});
}

void add_link_options(Rows& rows) {
  rows.push_back({.id = "links",
                  .value_name = "FILE",
                  .help = "Draw a stick for each row of a CSV file, whose columns first and second are the numbers of "
                          "two spheres, from 0",
                  .theme = OptionTheme::spheres,
                  .in_window = false,
                  .take = [](PictureRequest& request, const std::string& given) -> Status {
                    request.links = given;
                    return Done{};
                  }});
}

Rows all_rows() {
  Rows rows;
  add_picture(rows);
  add_style(rows);
  add_camera(rows);
  add_engine(rows);
  for (const RequestOption<InputOptions>& row : input_options())
    if (row.id != "radius_scale") rows.push_back(of_part(row, &PictureRequest::input));  // also an action
  add_spheres(rows);
  add_labels(rows);
  add_link_options(rows);
  return rows;
}

}  // namespace

const std::vector<RequestOption<InputOptions>>& input_options() {
  static const std::vector<RequestOption<InputOptions>> kRows = [] {
    std::vector<RequestOption<InputOptions>> rows{
        {.id = "count",
         .value_name = "N",
         .help = "Scenarios: number of spheres (4096)",
         .theme = OptionTheme::reading,
         .ranks = kWhole,
         .take = into<InputOptions, InputOptions>(
             &InputOptions::count,
             [](const std::string& text) { return whole_number_from_text(text, 1, kUnlimited); })},
        {.id = "seed",
         .value_name = "S",
         .help = "Scenarios: the seed of their random numbers (1)",
         .theme = OptionTheme::reading,
         .ranks = kWhole,
         .take = into<InputOptions, InputOptions>(&InputOptions::seed, seed_from)}};
    for (const ReadingSetting& setting : reading_settings()) {
      RequestOption<InputOptions> row{.id = std::string(setting.id),
                                      .value_name = std::string(setting.value_name),
                                      .help = setting.help,
                                      .theme = OptionTheme::reading,
                                      .ranks = setting.with_chunks ? kChunks : kWhole,
                                      .excludes = {setting.excludes.begin(), setting.excludes.end()}};
      row.take = [&setting](InputOptions& input, const std::string& text) {
        return input.reading.take(setting.id, text);
      };
      rows.push_back(std::move(row));
    }
    return rows;
  }();
  return kRows;
}

const std::vector<RequestOption<TreeParameters>>& tree_options() {
  static const std::vector<RequestOption<TreeParameters>> kRows{
      {.id = "max_prims",
       .value_name = "N|unlimited",
       .help = "Maximum spheres per leaf (the engine's choice; reference: 8)",
       .theme = OptionTheme::engine,
       .ranks = kChunks,
       .take = into<TreeParameters, TreeParameters>(&TreeParameters::max_prims, limit_from)},
      {.id = "max_depth",
       .value_name = "N|unlimited",
       .help = "Maximum levels of the tree (the engine's choice; reference: unlimited)",
       .theme = OptionTheme::engine,
       .ranks = kChunks,
       .take = into<TreeParameters, TreeParameters>(&TreeParameters::max_depth, limit_from)}};
  return kRows;
}

RequestOption<PictureRequest> samples_option(std::int64_t most) {
  return {.id = "samples",
          .value_name = "N|auto",
          .help = "Samples per pixel, 1 to " + std::to_string(most) +
                  " (files: 4, thesis scenes: 1, with an aperture 64);\nauto: 4, and 16 on edges",
          .ranks = kChunks,
          .take = [most](PictureRequest& request, const std::string& text) -> Status {
            const Result<std::int64_t> samples = samples_from(text, most);
            if (!samples) return samples.error();
            request.picture.set("samples_auto", *samples == kAutomaticSamples);
            if (*samples != kAutomaticSamples) request.picture.set("samples_per_pixel", *samples);
            return Done{};
          }};
}

const std::vector<RequestOption<PictureRequest>>& picture_options() {
  static const Rows kRows = all_rows();
  return kRows;
}

std::string picture_options_to_json() {
  static constexpr const char* kThemes[] = {"picture", "style", "camera", "engine", "reading", "spheres", "labels"};
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const Row& row : picture_options())
    rows.push_back({{"id", row.id},
                    {"option", option_of_setting(row.id)},
                    {"value", row.value_name},
                    {"help", row.help},
                    {"theme", kThemes[static_cast<std::size_t>(row.theme)]}});
  return as_text(rows, -1);
}

const RequestOption<PictureRequest>* picture_option(std::string_view id) {
  for (const Row& row : picture_options())
    if (row.id == id) return &row;
  return nullptr;
}

bool names_file(std::string_view id, const std::string& value) {
  if (id == "style") return !style_named(value);
  if (id == "element_colours") return !element_colours_called(value);
  if (id == "colour_by") return !colour_map_file(value).empty();
  return id == "title_values" || id == "trajectory" || id == "font" || id == "links";
}

std::vector<GivenSetting> files_named_by(const PictureRequest& request) {
  std::vector<GivenSetting> files;
  for (const GivenSetting& one : request.given)
    if (one.id != "colour_by" && names_file(one.id, one.value)) files.push_back(one);
  for (const std::string& map : request.looks.colour_map_files) files.push_back({"colour_by", map});
  return files;
}

void take_setting(PictureRequest& request, const std::string& id, const std::string& value) {
  const Row* const row = picture_option(id);
  if (row == nullptr) {
    std::vector<std::string> ids;
    for (const Row& each : picture_options()) ids.push_back(each.id);
    const std::string near = near_name(id, ids);
    fail_usage("there is no option " + setting_name(id),
               near.empty() ? std::string() : "did you mean " + setting_name(near) + "?");
  }
  const auto is_given = [&request](const std::string& other) {
    return std::any_of(request.given.begin(), request.given.end(),
                       [&other](const GivenSetting& one) { return one.id == other; });
  };
  if (!row->repeatable && is_given(id)) fail_setting(id, " is given more than once");
  for (const Row& other : picture_options())
    for (const std::string& excluded : other.excludes)
      if ((other.id == id && is_given(excluded)) || (excluded == id && is_given(other.id)))
        fail_setting(other.id, " excludes " + setting_name(excluded));
  if (const Status status = row->take(request, value); !status)
    fail_setting(id, ": " + status.error().message, status.error().hint);
  request.given.push_back({id, value});
}

void take_words(PictureRequest& request, const std::vector<std::string>& words) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word == "--") {
      if (i + 1 < words.size()) request.input.input = words[i + 1];
      return;
    }
    const std::size_t end = std::min(word.find('='), word.size());
    const std::string id = setting_of_option(word.substr(0, end));
    std::string value = end < word.size() ? word.substr(end + 1) : "";
    const Row* const row = picture_option(id);
    if (end == word.size() && row != nullptr && !row->value_name.empty() && i + 1 < words.size()) value = words[++i];
    take_setting(request, id, value);
  }
}

}  // namespace bihive
