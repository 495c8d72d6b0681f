#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

#include "bihive/settings/parameter.h"

namespace bihive {
namespace {

using P = PictureSettings;
using enum ParameterKind;
using Group = ParameterGroup;

// --- From members to values and back ------------------------------------------------------------------------------

template <class T>
SettingValue value_of(const T& member) {
  if constexpr (std::is_same_v<T, std::optional<std::string>> || std::is_same_v<T, std::optional<Vec3d>>)
    return member ? SettingValue(*member) : SettingValue();
  else if constexpr (std::is_same_v<T, double>)
    return std::isinf(member) ? SettingValue() : SettingValue(member);  // no limit
  else if constexpr (std::is_enum_v<T> || std::is_same_v<T, int>)
    return static_cast<std::int64_t>(member);
  else
    return member;
}

template <class T>
void put(const SettingValue& value, T& member) {
  const bool is_null = std::holds_alternative<std::monostate>(value);
  if constexpr (std::is_same_v<T, std::optional<std::string>>)
    member = is_null ? std::nullopt : std::optional(std::get<std::string>(value));
  else if constexpr (std::is_same_v<T, std::optional<Vec3d>>)
    member = is_null ? std::nullopt : std::optional(std::get<Vec3d>(value));
  else if constexpr (std::is_same_v<T, double>)
    member = is_null ? std::numeric_limits<double>::infinity() : std::get<double>(value);
  else if constexpr (std::is_enum_v<T> || std::is_same_v<T, int>)
    member = static_cast<T>(std::get<std::int64_t>(value));
  else
    member = std::get<T>(value);
}

// A row with access to its member.
template <auto Member>
constexpr Parameter row(Parameter parameter) {
  parameter.get = [](const P& s) { return value_of(s.*Member); };
  parameter.set = [](P& s, const SettingValue& value) { put(value, s.*Member); };
  return parameter;
}

// The same for a member of a member.
template <auto Outer, auto Member>
constexpr Parameter row(Parameter parameter) {
  parameter.get = [](const P& s) { return value_of((s.*Outer).*Member); };
  parameter.set = [](P& s, const SettingValue& value) { put(value, (s.*Outer).*Member); };
  return parameter;
}

// The same for a member of something that may be absent, which then has its default. Setting it makes the object
// present.
template <auto Outer>
using Content = typename std::remove_reference_t<decltype(std::declval<P>().*Outer)>::value_type;
template <auto Outer, auto Member>
constexpr Parameter part(Parameter parameter) {
  parameter.get = [](const P& s) { return value_of((s.*Outer).value_or(Content<Outer>{}).*Member); };
  parameter.set = [](P& s, const SettingValue& value) {
    if (!(s.*Outer)) (s.*Outer).emplace();
    put(value, *(s.*Outer).*Member);
  };
  return parameter;
}

// Whether an object is present.
template <auto Outer>
constexpr Parameter presence(Parameter parameter) {
  parameter.get = [](const P& s) -> SettingValue { return (s.*Outer).has_value(); };
  parameter.set = [](P& s, const SettingValue& value) {
    if (!std::get<bool>(value)) (s.*Outer).reset();
    if (std::get<bool>(value) && !(s.*Outer)) (s.*Outer).emplace();
  };
  return parameter;
}

// A number whose value 0 means that the object is absent.
template <auto Outer, auto Member>
constexpr Parameter strength(Parameter parameter) {
  parameter.get = [](const P& s) -> SettingValue { return s.*Outer ? *(s.*Outer).*Member : 0.0; };
  parameter.set = [](P& s, const SettingValue& value) {
    const double number = std::get<double>(value);
    if (number == 0) return (s.*Outer).reset();
    if (!(s.*Outer)) (s.*Outer).emplace();
    *(s.*Outer).*Member = number;
  };
  return parameter;
}

// A number of samples replaces adaptive ones, unless these are set too.
constexpr Parameter fixed_samples(Parameter parameter) {
  parameter = row<&P::samples_per_pixel>(parameter);
  parameter.set = [](P& s, const SettingValue& value) {
    put(value, s.samples_per_pixel);
    s.adaptive_samples = false;
  };
  return parameter;
}

constexpr double kLargest = 3.4028234663852886e38;

// --- The rows -----------------------------------------------------------------------------------------------------

// clang-format off
constexpr std::array kRows{
    row<&P::width_px>({.id = "width_px", .kind = whole, .least = 1, .most = kMostSidePx, .path = "width_px",
        .report = "width_px", .version = 1, .ranks = ParameterRanks::chunks,
        .has_option = false, .in_window = false, .help = "Width in pixels"}),
    row<&P::height_px>({.id = "height_px", .kind = whole, .least = 1, .most = kMostSidePx, .path = "height_px",
        .report = "height_px", .version = 1, .ranks = ParameterRanks::chunks,
        .has_option = false, .in_window = false, .help = "Height in pixels"}),
    row<&P::adaptive_samples>({.id = "samples_auto", .ranks = ParameterRanks::chunks,
        .has_option = false, .cpu_only = true,
        .help = "4 samples per pixel, and 16 on edges", .label = "more on edges",
        .long_label = "more samples on edges", .place = 1,
        .note = "The CPU engine alone draws more samples on edges"}),
    fixed_samples({.id = "samples_per_pixel", .kind = whole, .least = 1, .most = kMostSamplesPerPixel,
        .ranks = ParameterRanks::chunks, .has_option = false, .help = "Samples per pixel; 1: the pixel's centre",
        .label = "samples", .slider_least = 1, .slider_most = 64, .replaced_by = "samples_auto"}),
    row<&P::recursion>({.id = "recursion", .kind = whole, .least = 1, .most = kMostGenerations, .path = "recursion",
        .report = "recursion", .version = 1, .ranks = ParameterRanks::chunks,
        .help = "Generations of rays; 1: primary rays only", .usual = "5",
        .label = "recursion", .place = -1, .slider_least = 1, .slider_most = kMostGenerations}),
    row<&P::shadows>({.id = "shadows", .path = "shadows", .report = "shadows", .version = 1,
        .ranks = ParameterRanks::chunks,
        .has_no_option = true,
        .help = "Spheres cast shadows", .usual = "files: yes, thesis scenes: no", .group = Group::light, .label = "shadows",
        .place = -1}),
    presence<&P::ambient_occlusion>({.id = "ao", .path = "ambient_occlusion",
        .ranks = ParameterRanks::chunks,
        .has_no_option = true, .help = "Ambient occlusion: surfaces that see little of their surroundings are darker",
        .group = Group::light, .label = "occlusion", .long_label = "ambient occlusion"}),
    part<&P::ambient_occlusion, &AmbientOcclusion::distance>({.id = "ao_distance", .kind = number, .least = 0,
        .most = kLargest, .above_least = true, .nullable = true, .path = "ambient_occlusion.distance",
        .report = "ambient_occlusion.distance", .ranks = ParameterRanks::chunks, .implies = "ao", .value_name = "D",
        .help = "Reach of ambient occlusion in world units", .usual = "no limit", .group = Group::light,
        .label = "reach", .empty_means = "no limit"}),
    part<&P::ambient_occlusion, &AmbientOcclusion::directions>({.id = "ao_directions", .kind = whole, .least = 1,
        .most = kMostAmbientDirections, .path = "ambient_occlusion.directions",
        .report = "ambient_occlusion.directions", .ranks = ParameterRanks::chunks, .implies = "ao",
        .help = "Directions of ambient occlusion per sample", .usual = "64", .group = Group::light,
        .label = "directions", .slider_least = 1, .slider_most = 256}),
    row<&P::opacity_rule>({.id = "opacity_rule", .kind = choice, .names = "each_surface|once|first|as_one", .path = "opacity_rule",
        .report = "opacity_rule", .needs = ParameterNeeds::see_through,
        .ranks = ParameterRanks::chunks,
        .help = "Whether a transparent sphere weakens light at each surface, once, if it is the first of its opacity along a ray, or as one body with those of its opacity that overlap it", .usual = "the style's",
        .group = Group::light, .label = "opacity", .place = 1, .choice_labels = "at each surface|counts once|first surface alone|overlapping as one"}),
    row<&P::light_points>({.id = "light_points", .kind = whole, .least = 1, .most = kMostLightPoints,
        .path = "light_points", .report = "light_points", .needs = ParameterNeeds::soft_light,
        .ranks = ParameterRanks::chunks,
        .help = "Shadow rays per area light and sample", .usual = "the style's", .group = Group::light, .label = "soft rays",
        .place = -1, .slider_least = 1, .slider_most = 64, .only_with = "shadows"}),
    strength<&P::outline, &Outline::width_px>({.id = "outline_px", .alias = "outline", .kind = number, .least = 1,
        .most = kWidestOutlinePx, .or_zero = true, .path = "outline.width_px", .report = "outline_px",
        .ranks = ParameterRanks::chunks,
        .has_option = false, .value_name = "PX", .help = "Width of outlines in line units; 0: none", .usual = "the style's",
        .group = Group::lines, .label = "outlines", .slider_least = 0, .slider_most = kWidestOutlinePx}),
    part<&P::outline, &Outline::step>({.id = "outline_step", .kind = number, .least = 0, .most = kLargest,
        .path = "outline.step", .ranks = ParameterRanks::chunks, .implies = "outline_px", .value_name = "F",
        .help = "Minimum depth step at an outline, in radii of the sphere in front", .usual = "2", .group = Group::lines}),
    part<&P::outline, &Outline::colour>({.id = "outline_colour", .kind = colour, .path = "outline.colour",
        .ranks = ParameterRanks::chunks,
        .implies = "outline_px", .value_name = "COLOUR", .help = "Colour of outlines", .usual = "black",
        .group = Group::lines}),
    row<&P::line_unit>({.id = "line_unit", .kind = choice, .names = "px|picture|pt", .path = "line_unit",
        .report = "line_unit", .ranks = ParameterRanks::chunks,
        .help = "Unit of the widths of outlines, creases and cell edges: pixels, 1/720 of the picture's shorter side, or points in print",
        .usual = "styles: picture, scene files: px", .group = Group::lines}),
    row<&P::sticks, &Sticks::bonds>({.id = "bonds", .kind = choice, .names = "none|distance|file|auto", .path = "bonds",
        .report = "bonds", .cpu_only = true, .makes_sticks = true,
        .help = "Draw sticks between bonded atoms: those nearer than their covalent radii allow, those that the file states, or both (docs/pictures.md)",
        .usual = "the style's", .group = Group::lines,
        .label = "bonds", .place = 1, .choice_labels = "none|by distance|of the file|both"}),
    row<&P::sticks, &Sticks::reach>({.id = "bond_reach", .kind = number, .least = 0, .most = kMostBondReach,
        .above_least = true, .path = "bond_reach", .report = "bond_reach", .cpu_only = true, .makes_sticks = true,
        .value_name = "F", .help = "The longest bond, in sums of both atoms' covalent radii", .usual = "1.2",
        .group = Group::lines}),
    row<&P::sticks, &Sticks::orders>({.id = "bond_orders", .path = "bond_orders", .report = "bond_orders",
        .has_no_option = true, .cpu_only = true, .makes_sticks = true,
        .help = "Draw double and triple bonds of the file as parallel sticks, aromatic ones with a dashed one",
        .usual = "the style's", .group = Group::lines,
        .label = "bond orders", .place = 1}),
    row<&P::sticks, &Sticks::radius>({.id = "stick_radius", .kind = number, .least = 0, .most = kLargest,
        .above_least = true, .path = "stick_radius", .report = "stick_radius", .cpu_only = true, .makes_sticks = true,
        .value_name = "R", .help = "Radius of the sticks in world units", .usual = "0.15, or the style's",
        .group = Group::lines,
        .label = "stick radius", .place = 1}),
    row<&P::sticks, &Sticks::ball_scale>({.id = "ball_scale", .kind = number, .least = 0, .most = kLargest,
        .path = "ball_scale", .report = "ball_scale", .cpu_only = true, .makes_sticks = true, .value_name = "F",
        .help = "With bonds: multiplies all radii; 0: balls as thick as the sticks", .usual = "1, or the style's",
        .group = Group::lines,
        .label = "balls", .long_label = "size of balls", .place = 1}),
    row<&P::arrows, &Arrows::components>({.id = "arrows", .kind = text, .path = "arrows", .report = "arrows",
        .cpu_only = true, .makes_sticks = true, .value_name = "VX,VY,VZ",
        .help = "Draw an arrow on each sphere, along the vector that these attributes are; arithmetic too: fx/m,fy/m,fz/m",
        .group = Group::lines,
        .label = "arrows", .long_label = "arrows (vx,vy,vz)", .place = 3, .empty_means = "none"}),
    row<&P::arrows, &Arrows::select>({.id = "arrow_select", .kind = text, .path = "arrow_select",
        .report = "arrow_select", .cpu_only = true, .makes_sticks = true, .value_name = "SELECTION",
        .help = "The spheres that have arrows", .usual = "all", .group = Group::lines}),
    row<&P::arrows, &Arrows::scale>({.id = "arrow_scale", .kind = number, .least = 0, .most = kLargest,
        .above_least = true, .path = "arrow_scale", .report = "arrow_scale", .cpu_only = true, .makes_sticks = true,
        .value_name = "F", .help = "Length of an arrow in world units, for a vector of length 1", .usual = "1",
        .group = Group::lines,
        .label = "arrow length", .place = 3}),
    row<&P::arrows, &Arrows::share>({.id = "arrow_share", .kind = number, .least = 0, .most = 1,
        .path = "arrow_share", .report = "arrow_share", .cpu_only = true, .makes_sticks = true, .value_name = "F",
        .help = "Length of the longest arrow as a share of the set's longest side, in place of the scale; 0: by the scale",
        .usual = "0", .group = Group::lines}),
    row<&P::arrows, &Arrows::radius>({.id = "arrow_radius", .kind = number, .least = 0, .most = kLargest,
        .above_least = true, .nullable = true, .path = "arrow_radius", .report = "arrow_radius",
        .cpu_only = true, .makes_sticks = true, .value_name = "R",
        .help = "Radius of the shafts of arrows in world units",
        .usual = "a quarter of the sphere's", .group = Group::lines}),
    row<&P::arrows, &Arrows::pivot>({.id = "arrow_pivot", .kind = choice, .names = "tail|middle", .path = "arrow_pivot",
        .report = "arrow_pivot", .cpu_only = true, .makes_sticks = true,
        .help = "The point of an arrow that is at the centre of its sphere", .usual = "tail", .group = Group::lines}),
    row<&P::arrows, &Arrows::colour>({.id = "arrow_colour", .kind = text, .path = "arrow_colour",
        .report = "arrow_colour", .cpu_only = true, .makes_sticks = true, .value_name = "COLOUR|ATTR[:MAP][:MIN,MAX]",
        .help = "Colour of arrows, or an attribute that colours them, with a map and a range", .usual = "the sphere's",
        .group = Group::lines,
        .label = "arrow colour", .place = 3, .empty_means = "the sphere's"}),
    row<&P::traces, &Traces::by>({.id = "trace", .kind = choice, .names = "none|chain|mol", .path = "trace",
        .report = "trace", .cpu_only = true, .makes_sticks = true,
        .help = "Draw a tube through the beads of each chain, or of each molecule of the column mol",
        .usual = "none", .group = Group::lines,
        .label = "tubes", .place = 4, .choice_labels = "none|by chain|by molecule"}),
    row<&P::traces, &Traces::select>({.id = "trace_select", .kind = text, .path = "trace_select",
        .report = "trace_select", .cpu_only = true, .makes_sticks = true, .value_name = "SELECTION",
        .help = "The beads of tubes", .usual = "CA and P, or all where there are none", .group = Group::lines}),
    row<&P::traces, &Traces::radius>({.id = "trace_radius", .kind = text, .path = "trace_radius",
        .report = "trace_radius", .cpu_only = true, .makes_sticks = true, .value_name = "R|ATTR",
        .help = "Radius of tubes in world units: a number, an attribute, or arithmetic: b_factor/50",
        .usual = "a quarter of the bead's", .group = Group::lines,
        .label = "tube radius", .place = 4, .empty_means = "a quarter of the bead's"}),
    row<&P::traces, &Traces::atoms>({.id = "trace_atoms", .kind = choice, .names = "hidden|shown", .path = "trace_atoms",
        .report = "trace_atoms", .cpu_only = true, .makes_sticks = true,
        .help = "Whether the spheres of traced residues are drawn too", .usual = "hidden", .group = Group::lines}),
    row<&P::trails, &Trails::frames>({.id = "trail", .kind = whole, .least = 0, .most = kLongestTrail, .path = "trail",
        .report = "trail", .in_window = false, .cpu_only = true, .value_name = "N",
        .help = "Draw the path of each sphere through the N frames before as a thin stick that fades; 0: none",
        .usual = "0", .group = Group::lines}),
    row<&P::trails, &Trails::select>({.id = "trail_select", .kind = text, .path = "trail_select",
        .report = "trail_select", .in_window = false, .cpu_only = true, .value_name = "SELECTION",
        .help = "The spheres that have trails", .usual = "all", .group = Group::lines}),
    row<&P::trails, &Trails::radius>({.id = "trail_radius", .kind = number, .least = 0, .most = kLargest,
        .above_least = true, .nullable = true, .path = "trail_radius", .report = "trail_radius", .in_window = false,
        .cpu_only = true, .value_name = "R", .help = "Radius of trails in world units",
        .usual = "a fifth of the sphere's", .group = Group::lines}),
    row<&P::hydrogen_bonds, &HydrogenBonds::shown>({.id = "hbonds", .path = "hbonds", .report = "hbonds",
        .has_no_option = true, .cpu_only = true, .makes_sticks = true,
        .help = "Draw hydrogen bonds as dashes, found by distance and angle (docs/pictures.md)",
        .group = Group::lines,
        .label = "hydrogen bonds", .place = 2}),
    row<&P::hydrogen_bonds, &HydrogenBonds::radius>({.id = "hbond_radius", .kind = number, .least = 0, .most = kLargest,
        .above_least = true, .path = "hbond_radius", .report = "hbond_radius", .cpu_only = true, .makes_sticks = true,
        .value_name = "R", .help = "Radius of the dashes of hydrogen bonds in world units", .usual = "0.06",
        .group = Group::lines}),
    row<&P::hydrogen_bonds, &HydrogenBonds::colour>({.id = "hbond_colour", .kind = colour, .path = "hbond_colour",
        .report = "hbond_colour", .cpu_only = true, .makes_sticks = true, .value_name = "COLOUR",
        .help = "Colour of hydrogen bonds", .usual = "blue", .group = Group::lines}),
    row<&P::links, &Links::contact_probe>({.id = "show_contacts", .kind = number, .least = 0, .most = kLargest,
        .nullable = true, .path = "show_contacts", .report = "show_contacts", .cpu_only = true, .makes_sticks = true,
        .value_name = "R",
        .help = "Draw a link between each two spheres in contact, found with a probe of this radius (docs/measures.md)",
        .usual = "none", .group = Group::lines,
        .label = "contacts", .long_label = "contacts (probe)", .place = 5, .empty_means = "none"}),
    row<&P::links, &Links::radius>({.id = "link_radius", .kind = text, .path = "link_radius", .report = "link_radius",
        .cpu_only = true, .makes_sticks = true, .value_name = "R|COLUMN[:F]",
        .help = "Radius of links in world units, or F times a column such as area",
        .usual = "a quarter of the smaller sphere's", .group = Group::lines,
        .label = "link radius", .place = 5, .empty_means = "a quarter of the smaller sphere's"}),
    row<&P::links, &Links::colour>({.id = "link_colour", .kind = text, .path = "link_colour", .report = "link_colour",
        .cpu_only = true, .makes_sticks = true, .value_name = "COLOUR|COLUMN[:MAP][:MIN,MAX]",
        .help = "Colour of links, or a column that colours them, such as area:magma",
        .usual = "their spheres'", .group = Group::lines,
        .label = "link colour", .place = 5, .empty_means = "their spheres'"}),
    row<&P::links, &Links::dashed>({.id = "link_dashes", .path = "link_dashes", .report = "link_dashes",
        .cpu_only = true, .makes_sticks = true, .help = "Draw links as dashes", .group = Group::lines,
        .label = "dashed links", .place = 5}),
    row<&P::cavity_probe>({.id = "show_cavities", .kind = number, .least = 0, .most = kLargest, .nullable = true,
        .path = "show_cavities", .report = "show_cavities", .in_window = false, .cpu_only = true, .value_name = "R",
        .help = "In place of the spheres draw the walls of the cavities that they enclose, where a probe of this radius can be (docs/measures.md)",
        .usual = "none", .group = Group::lines}),
    strength<&P::fog, &Fog::strength>({.id = "fog", .kind = number, .least = 0, .most = 1, .path = "fog.strength",
        .report = "fog", .ranks = ParameterRanks::chunks, .value_name = "F",
        .help = "Share of the background at the set's farthest point; 0: none", .usual = "the style's", .group = Group::light,
        .label = "fog", .slider_least = 0, .slider_most = 1, .slider_step = 0.05, .unit = "%"}),
    part<&P::fog, &Fog::start>({.id = "fog_start", .kind = number, .least = -kLargest, .most = kLargest,
        .path = "fog.start", .ranks = ParameterRanks::chunks, .implies = "fog", .value_name = "F",
        .help = "Depth where fog begins: 0 at the set's nearest point, 1 at its farthest", .usual = "0",
        .group = Group::light}),
    part<&P::fog, &Fog::end>({.id = "fog_end", .kind = number, .least = -kLargest, .most = kLargest,
        .path = "fog.end", .ranks = ParameterRanks::chunks, .implies = "fog", .value_name = "F",
        .help = "Depth where fog reaches its full strength; above its start", .usual = "1",
        .group = Group::light}),
    presence<&P::cell_lines>({.id = "cell", .path = "cell_lines", .report = "cell", .ranks = ParameterRanks::whole,
        .cpu_only = true,
        .help = "Draw the edges of the periodic cell, and of its copies", .group = Group::cell, .label = "edges",
        .note = "The CPU engine alone draws the cell and its copies"}),
    part<&P::cell_lines, &CellLines::width_px>({.id = "cell_width", .kind = number, .least = 1,
        .most = kWidestOutlinePx, .path = "cell_lines.width_px", .ranks = ParameterRanks::whole,
        .implies = "cell", .value_name = "PX",
        .help = "Width of the cell's edges in line units", .usual = "2", .group = Group::cell}),
    part<&P::cell_lines, &CellLines::colour>({.id = "cell_colour", .kind = colour, .path = "cell_lines.colour",
        .ranks = ParameterRanks::whole,
        .implies = "cell", .value_name = "COLOUR", .help = "Colour of the cell's edges", .usual = "nearly black; light before a dark background",
        .group = Group::cell}),
    row<&P::transparent>({.id = "transparent", .path = "transparent", .ranks = ParameterRanks::chunks,
        .has_option = false, .in_window = false,
        .help = "The picture has opacity instead of a background"}),
    row<&P::matte>({.id = "matte", .kind = colour, .nullable = true, .path = "matte", .report = "matte",
        .ranks = ParameterRanks::chunks, .in_window = false, .value_name = "COLOUR",
        .help = "With a transparent background: the colour that will lie behind the picture, to which edges, fog and letters are fitted"}),
    row<&P::fit_share>({.id = "fit_share", .kind = number, .least = kLeastFitShare, .most = 1, .path = "fit_share",
        .report = "fit_share", .ranks = ParameterRanks::whole, .value_name = "F",
        .help = "The share of the spheres, along each axis, that the camera brings into view: 0.98 leaves out 1 % at either end", .usual = "1, or the style's"}),
    row<&P::stereo, &Stereo::form>({.id = "stereo", .kind = choice, .names = "none|side|cross|anaglyph",
        .path = "stereo", .report = "stereo", .ranks = ParameterRanks::whole, .in_window = false, .cpu_only = true,
        .help = "Views of both eyes: next to each other, the same for crossed eyes, or red and cyan", .usual = "none"}),
    row<&P::stereo, &Stereo::eye_distance>({.id = "eye_distance", .kind = number, .least = 0, .most = kMostEyeDistance,
        .above_least = true, .path = "eye_distance", .report = "eye_distance", .ranks = ParameterRanks::whole,
        .in_window = false, .cpu_only = true,
        .value_name = "F",
        .help = "Of stereo pictures: the distance between the eyes as a share of that to the camera's target", .usual = "1/30"}),
    row<&P::tone, &Tone::exposure_stops>({.id = "exposure", .kind = number, .least = -kMostExposureStops,
        .most = kMostExposureStops, .path = "exposure", .report = "exposure", .ranks = ParameterRanks::chunks,
        .value_name = "EV",
        .help = "Stops: all light times 2^EV; the background keeps its colour", .usual = "the style's", .group = Group::tone,
        .label = "exposure", .slider_least = -4, .slider_most = 4, .slider_step = 0.25}),
    row<&P::tone, &Tone::curve>({.id = "tone", .kind = choice, .names = "none|soft|filmic", .path = "tone",
        .report = "tone", .ranks = ParameterRanks::chunks,
        .help = "Curve for light that is too bright for the picture", .usual = "the style's",
        .group = Group::tone, .label = "tone", .choice_labels = "cut off|soft|filmic"}),
    row<&P::labels, &Labels::title>({.id = "title", .kind = text, .path = "title", .report = "labels.title",
        .ranks = ParameterRanks::chunks, .value_name = "TEXT",
        .help = "Title at the top; {time}, {step}, {frame}, {spheres} are values of the\n"
                "frame, {time:.2f} has two digits after the point",
        .group = Group::labels, .label = "title"}),
    row<&P::labels, &Labels::legend>({.id = "legend", .path = "legend", .report = "labels.legend",
        .ranks = ParameterRanks::whole,
        .help = "Legend of the colours: a colour bar, or names", .group = Group::labels, .label = "legend",
        .long_label = "legend of the colours"}),
    row<&P::labels, &Labels::legend_title>({.id = "legend_title", .kind = text, .path = "legend_title",
        .report = "labels.legend_title", .ranks = ParameterRanks::whole, .value_name = "TEXT",
        .help = "Title of the legend's colour bar or names, with its unit", .usual = "the attribute's name",
        .group = Group::labels, .label = "legend title", .empty_means = "the attribute's name", .only_with = "legend"}),
    row<&P::labels, &Labels::axes>({.id = "axes", .path = "axes", .report = "labels.axes",
        .ranks = ParameterRanks::chunks,
        .help = "Show the directions of x, y and z", .group = Group::labels, .label = "axes"}),
    row<&P::labels, &Labels::scale_bar>({.id = "scale_bar", .path = "scale_bar", .report = "labels.scale_bar",
        .needs = ParameterNeeds::orthographic, .ranks = ParameterRanks::chunks,
        .help = "Show a round length of the world; for orthographic pictures",
        .group = Group::labels, .label = "scale bar", .note = "A scale bar needs the projection orthographic"}),
    row<&P::labels, &Labels::length_unit>({.id = "length_unit", .kind = text, .nullable = true,
        .path = "length_unit", .report = "labels.length_unit", .ranks = ParameterRanks::chunks, .value_name = "TEXT",
        .help = "Unit after the scale bar's number", .usual = "PDB, mmCIF: \u00C5; else none", .group = Group::labels,
        .label = "unit", .empty_means = "the file's", .only_with = "scale_bar"}),
    row<&P::transfer>({.id = "transfer", .kind = choice, .names = "srgb|none", .path = "transfer", .version = 1,
        .ranks = ParameterRanks::chunks,
        .in_window = false, .help = "Curve from radiance to pixels", .usual = "files: srgb, thesis scenes: none"}),
};
// clang-format on

}  // namespace

std::span<const Parameter> picture_parameters() {
  return kRows;
}

}  // namespace bihive
