#include "command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <functional>

#include "bihive/base/parse_number.h"
#include "bihive/base/setting_name.h"
#include "bihive/base/version.h"
#include "bihive/io/known_formats.h"
#include "bihive/job/failure.h"
#include "bihive/select/selection.h"
#include "bihive/viewer/cards.h"
#include "commands/names.h"
#include "compare_options.h"
#include "film/film_plan.h"
#include "request_options.h"
#include "server/addresses.h"
#include "value_options.h"
#include "words/given_options.h"
#include "words/short_help.h"

namespace bihive::cli {
namespace {

constexpr std::int64_t kLargestPort = 65535;
constexpr const char* kSceneSave = "scene-save";

template <class Target, class T>
CLI::Option* add_choice(CLI::App& app, const std::string& name, Target& target, const Names<T>& names,
                        const std::string& help) {
  return add_value(app, name, target, list_of(names), help,
                   [&names](const std::string& text) { return choice_from(text, names); });
}

CLI::Option* add_path(CLI::App& app, const std::string& name, std::string& target, const std::string& help) {
  return app.add_option(name, target, help)->type_name("FILE")->required();
}

void add_generator_options(CLI::App& app, InputOptions& input) {
  for (const char* const id : {"count", "seed"}) add_input_option(app, id, input);
}

InputOptions& input_of(InputOptions& input) {
  return input;
}
InputOptions& input_of(PictureRequest& request) {
  return request.input;
}
const auto& rows_for(const InputOptions&) {
  return input_options();
}
const auto& rows_for(const PictureRequest&) {
  return picture_options();
}

// `alone`: no other positional argument follows INPUT. `Request`: of an input, or of a picture.
template <class Request>
void add_trajectory(CLI::App& app, Request& request, bool alone = true) {
  for (const RequestOption<Request>& row : rows_for(request))
    if (row.id == "trajectory") add_option_of(app, row, request, alone ? "TRAJECTORY," : "");
}

template <class Request>
void add_input(CLI::App& app, Request& request, bool alone = true, bool required = true) {
  app.add_option("INPUT", input_of(request).input,
                 in_lines("A file (" + names_of_formats(FormatsThat::hold_spheres) +
                          ", or scene JSON) or a built-in name: scenario1, scenario2, scenario3, four-spheres, demo; "
                          "- is the standard input") +
                     (required ? "" : " (demo)"))
      ->type_name("")
      ->required(required);
  add_trajectory(app, request, alone);
}

void add_input_options(CLI::App& app, InputOptions& input) {
  for (const RequestOption<InputOptions>& row : input_options())
    if (row.id != "trajectory") add_option_of(app, row, input);
}

void add_tree_options(CLI::App& app, TreeParameters& tree) {
  for (const RequestOption<TreeParameters>& row : tree_options()) add_option_of(app, row, tree);
}

void add_threads(CLI::App& app, std::int64_t& threads) {
  add_integer(app, "--threads", threads, 0, kMostThreads, picture_option("threads")->help);
}

void add_json_flag(CLI::App& app, bool& json) {
  app.add_flag("--json", json, "Print one JSON object instead of text");
}

// The parser's error, which begins with the faulty option: "--radius: expected a number, found ...".
void fail_with_option(const std::string& what, const std::string& advice) {
  const std::size_t end = what.starts_with("--") ? what.find_first_of(": ") : 0;
  if (end == 0 || end == std::string::npos) return;
  fail_setting(setting_of_option(what.substr(0, end)), what.substr(end), advice);
}

// A sub-command whose help ends in two examples. Calling it sets `request` to `options`.
template <class Options>
CLI::App& add_command(CLI::App& app, const std::string& name, const std::string& help, const std::string& first_example,
                      const std::string& second_example, const Options& options, Request& request) {
  CLI::App* command = app.add_subcommand(name, help);
  command->footer("Examples:\n  " + first_example + "\n  " + second_example);
  command->final_callback([&options, &request] { request = options; });
  return *command;
}

// The heading of the options added after this call.
void begin_theme(CLI::App& command, const std::string& heading) {
  command.option_defaults()->group(heading);
}

// The options of a picture's appearance, for commands that draw one or many. `without`: ids to leave out.
void add_options_by_theme(CLI::App& command, RenderOptions& options, std::vector<std::string_view> without = {},
                          bool with_json = true) {
  static constexpr std::pair<OptionTheme, const char*> kThemes[] = {
      {OptionTheme::picture, "Picture"},       {OptionTheme::style, "Style and light"},
      {OptionTheme::camera, "Camera"},         {OptionTheme::engine, "Engine"},
      {OptionTheme::reading, "Reading"},       {OptionTheme::spheres, "Spheres"},
      {OptionTheme::labels, "Labels and cell"}};
  without.push_back("trajectory");  // listed beside INPUT
  for (const auto& [theme, heading] : kThemes) {
    begin_theme(command, heading);
    add_picture_options(command, theme, options, /*of_window=*/false, without);
    if (theme == OptionTheme::engine && with_json) add_json_flag(command, options.json);
  }
  begin_theme(command, "Other options");
}

constexpr const char* kNoMetadata = "Leave out of the file how it was made";

void add_render(CLI::App& app, RenderOptions& options, Request& request) {
  CLI::App& command = add_command(
      app, "render", "Render a picture", "bihive render demo -o molecule.png --view-from iso --background black",
      "bihive render scenario2 -o corners.png --size 640x480 --recursion 3 --count 256", options, request);
  add_input<PictureRequest>(command, options);
  add_path(command, "-o,--output", options.output,
           "The picture: PNG, TIFF (.tif) or OpenEXR (.exr); - writes a PNG to the standard\noutput");
  add_value(command, "--layers", options.layers, "L,L...",
            ".exr: its layers: radiance, albedo, depth, normal, id, attribute:NAME\n(radiance)", layers_from_text);
  add_options_by_theme(command, options);
  command
      .add_option("--film", options.film,
                  "Draw a picture of this film (bihive film), with its options and camera:\nFILE.json")
      ->type_name("FILE");
  command.add_flag_callback(
      "--no-metadata", [&options] { options.metadata = false; }, kNoMetadata);
  command.add_flag("--methods", options.methods, "Print a sentence for a methods section too, and an entry for BibTeX");
  add_integer(command, "--picture", options.picture_of_film, 0, kUnlimited,
              "--film: which one of its pictures, from 0; or name its frame by --frame");
}

void add_again(CLI::App& app, AgainOptions& options, Request& request) {
  CLI::App& command =
      add_command(app, "again", "Draw the picture of a file that bihive made once more, or with changes",
                  "bihive again figure.png -o larger.png --size 2400x1600",
                  "bihive again figure.png other_molecule.pdb -o other.png", options, request);
  command.add_option("FIGURE", options.figure, "A picture or a film that bihive made")->type_name("")->required();
  add_input<PictureRequest>(command, options.changes);
  command.get_option("INPUT")->required(false);
  command
      .add_option("-o,--output", options.changes.output,
                  "The new picture or film (FIGURE-again, with the ending of FIGURE)")
      ->type_name("FILE");
  command.add_flag_callback(
      "--no-metadata", [&options] { options.changes.metadata = false; }, kNoMetadata);
  add_options_by_theme(command, options.changes);
}

void add_verify(CLI::App& app, VerifyOptions& options, Request& request) {
  CLI::App& command = add_command(app, "verify", "Draw pictures that bihive made once more, and compare every bit",
                                  "bihive verify figure.png", "bihive verify figures/ --json", options, request);
  command
      .add_option(
          "FIGURE", options.figures,
          "Pictures and films that bihive made, or folders of them; last, if it lies neither\nbeside the figure nor "
          "here, the input")
      ->type_name("")
      ->required();
  command.add_option("--difference", options.difference, "Written: a picture of where they differ; of one figure")
      ->type_name("FILE");
  CLI::Option* methods = command.add_flag("--methods", options.methods,
                                          "Print a sentence for a methods section instead, and an entry for BibTeX");
  add_json_flag(command, options.json);
  methods->excludes(command.get_option("--difference"))->excludes(command.get_option("--json"));
}

Result<std::string> film_selection_from(const std::string& text) {
  if (const Status status = check_selection(text); !status) return status.error();
  return text;
}

void add_film(CLI::App& app, FilmOptions& options, Request& request, int argc, const char* const* argv) {
  CLI::App& command = add_command(app, "film", "Make a film of a trajectory, or of a camera that moves",
                                  "bihive film run.xyz -o run.mp4 --fps 30 --title 't = {time:.1f} ps'",
                                  "bihive film demo -o turn.mp4 --turntable 360 --size 640x480", options, request);
  command.final_callback([&options, &request, &command, argc, argv] {
    options.words = picture_words(command, argc, argv);
    request = options;
  });
  RenderOptions& picture = options.picture;
  add_input<PictureRequest>(command, picture);
  command.get_option("INPUT")->required(false);
  add_path(command, "-o,--output", picture.output,
           "The film: .mp4, .mov, .mkv, .webm, .gif or .apng by the program ffmpeg; .y4m; or\nPNG files: run/%05d.png");
  add_value(command, "--frames", options.frames, "A:B:STEP",
            "Every STEP-th frame from A to before B (all); negative: from the end", frame_range_from_text);
  add_value(command, "--fps", options.rate, "N", "Pictures per second (25), also 29.97 or 30000/1001", frame_rate_from);
  add_integer(command, "--pictures", options.pictures, 1, kUnlimited,
              "Number of pictures of an input with one frame (ten seconds, or all keys)");
  add_integer(command, "--hold-first", options.order.hold_first, 0, kMostPictures,
              "Show the first picture N more times (0)");
  add_integer(command, "--hold-last", options.order.hold_last, 0, kMostPictures,
              "Show the last picture N more times (0)");
  command.add_flag("--reverse", options.order.reverse, "Show the pictures backwards");
  command.add_flag("--ping-pong", options.order.ping_pong,
                   "Show the pictures forwards, then backwards, without the ends: the film loops");
  add_value(command, "--turntable", options.turntable_deg, "DEG",
            "Rotation of the camera around the scene, over the whole film",
            [](const std::string& text) { return number_from_text(text, -1e6, 1e6); });
  static const Names<std::string> kAxes{{"x", "x"}, {"y", "y"}, {"z", "z"}, {"picture", "picture"}};
  add_choice(command, "--turn-axis", options.turn_axis, kAxes,
             "Axis of --turntable: x, y or z of the world, or the picture's vertical (the world's up direction)");
  add_value(command, "--follow", options.follow, "EXPR",
            "The camera moves with these spheres, through the boundaries of a periodic cell too", film_selection_from);
  add_value(command, "--align", options.align, "EXPR",
            "Move and turn all spheres of each frame until these lie over those of the first frame",
            film_selection_from);
  add_choice(command, "--fit-frames", options.fit_frames, kFittedFrames,
             "The frames whose spheres the camera brings into view: the first, all of them (reads the film\n"
             "twice), or each picture those of its own (first)");
  command.add_option("--camera-keys", options.camera_keys, "Key frames of the camera: docs/films.md")
      ->type_name("FILE");
  add_choice(command, "--colour-range", options.range_of_colours, kRangesOfColours,
             "Ranges of --colour-by without MIN,MAX: of the first frame, of the whole film (reads\n"
             "it twice), or of each frame (first)");
  command
      .add_option("--codec", options.codec, "ffmpeg's options for the codec (H.264, webm: VP9): '-c:v libx265 -crf 20'")
      ->type_name("WORDS");
  add_value(command, "--shard", options.shard, "i/N",
            "Draw every N-th picture from number i on; another command joins all N", shard_from);
  command.add_flag("--join", options.join, "Join the shards of the film -o, without INPUT");
  command.add_flag_callback(
      "--no-metadata", [&picture] { picture.metadata = false; }, kNoMetadata);
  add_options_by_theme(command, picture, {"frame"});
}

// The options of window and page.
void add_options_to_show(CLI::App& command, ViewOptions& options, bool of_page,
                         std::vector<std::string_view> without = {}) {
  static const RequestOption<PictureRequest> samples = samples_option(kMostSamples);
  add_option_of<PictureRequest>(command, samples, options);
  without.insert(without.end(), {"size", "engine", "samples", "trajectory"});
  for (const RequestOption<PictureRequest>& row : picture_options())
    if (of_page && !row.in_page) without.push_back(row.id);
  for (const OptionTheme theme : {OptionTheme::style, OptionTheme::picture, OptionTheme::camera, OptionTheme::engine,
                                  OptionTheme::reading, OptionTheme::spheres, OptionTheme::labels})
    add_picture_options(command, theme, options, /*of_window=*/true, without);
}

void add_view(CLI::App& app, ViewOptions& options, Request& request) {
  CLI::App& command =
      add_command(app, "view", "Look at it in a window: turn it, switch views, engines and trees",
                  "bihive view data/1hpv.pdb --view-from left",
                  "bihive view scenario2 --engine gpu --max-prims 1 --view traversal", options, request);
  add_input<PictureRequest>(command, options, /*alone=*/true, /*required=*/false);
  add_value(command, "--size", options.size, "WxH", "The window (1280x800)", size_from);
  add_choice(command, "--engine", options.window_engine, kViewerEngines, "The engine (cpu)");
  add_options_to_show(command, options, /*of_page=*/false);
  static const Names<std::string> kCards = [] {
    Names<std::string> names;
    for (const Card& card : cards()) names.emplace_back(card.id, card.id);
    return names;
  }();
  add_choice(command, "--card", options.card, kCards, "The card of controls that is open at first (none)");
  command.add_option("--screenshot", options.screenshot, "Write the settled window into a PNG, and end")
      ->type_name("FILE");
}

void add_stats(CLI::App& app, StatsOptions& options, Request& request) {
  CLI::App& command = add_command(app, "stats", "Build both trees and print their statistics", "bihive stats demo",
                                  "bihive stats scenario2 --max-prims 1 --seed 7 --json", options, request);
  add_input(command, options.input);
  add_tree_options(command, options.tree);
  add_input_options(command, options.input);
  add_json_flag(command, options.json);
}

void add_compare(CLI::App& app, CompareOptions& options, Request& request) {
  CLI::App& command = add_command(
      app, "compare", "Compare trees and grids on these spheres: built, counted, timed", "bihive compare demo",
      "bihive compare scenario2 --structures bih,kd-sah --sweep max-prims=1,2,4,8 --json", options, request);
  add_input(command, options.input);
  add_compare_options(command, options);
  add_input_options(command, options.input);
  add_json_flag(command, options.json);
}

void add_tune(CLI::App& app, TuneCommandOptions& options, Request& request) {
  CLI::App& command =
      add_command(app, "tune", "Search the tree's parameters that suit these spheres, in about ten seconds",
                  "bihive tune demo", "bihive tune scenario2 --structure bih --rays primary,shadow", options, request);
  add_input(command, options.input);
  add_tune_options(command, options);
  add_input_options(command, options.input);
  add_json_flag(command, options.json);
}

void add_styles(CLI::App& app, StylesOptions& options, Request& request) {
  CLI::App& command = add_command(app, "styles", "List the styles for bihive render --style", "bihive styles",
                                  "bihive styles --json", options, request);
  add_json_flag(command, options.json);
}

void add_trace(CLI::App& app, TraceOptions& options, Request& request) {
  CLI::App& command = add_command(
      app, "trace", "Trace rays from a .npy file", "bihive trace scenario1 --rays rays.npy --t t.npy --id id.npy",
      "bihive trace demo --rays rays.npy --t t.npy --id id.npy --any --threads 2", options, request);
  add_input(command, options.input);
  add_path(command, "--rays", options.rays,
           "float32 (n, 6): origin, direction; or (n, 8): and t_min, t_max; -: from the standard input");
  add_path(command, "--t", options.t,
           "Written: float64 (n), the hit is at origin + t direction; inf for none;\n- for this or --id is the "
           "standard output");
  add_path(command, "--id", options.id, "Written: int64 (n), position in the set; -1 for nothing, -2 for the plane");
  command.add_flag("--any", options.any, "Whether anything is hit: id 0 or -1, t 0 or inf");
  command.add_flag("--plane", options.plane, "Trace the plane too: the scene's own, else the thesis's");
  add_choice(command, "--engine", options.engine, kEngines, "The engine (auto); all give the same bits");
  add_tree_options(command, options.tree);
  command.add_flag("--tune", options.tune,
                   "Search the tree's limits that suit these spheres, in about ten seconds, as bihive tune\n--rays "
                   "random does; answers keep their bits");
  add_threads(command, options.threads);
  add_input_options(command, options.input);
}

void add_scene(CLI::App& app, SceneOptions& options, Request& request) {
  CLI::App& command = add_command(app, "scene", "Write a scene of the thesis into a file",
                                  "bihive scene scenario3 --count 1000 --radius 0.5 --seed 2 -o spheres.npy",
                                  "bihive scene four-spheres -o four.json", options, request);
  command.add_option("NAME", options.input.input, "scenario1, scenario2, scenario3 or four-spheres")
      ->type_name("")
      ->required();
  add_generator_options(command, options.input);
  add_input_option(command, "radius", options.input);
  add_path(command, "-o,--output", options.output,
           ".npy: x, y, z, r as float32 (n, 4); .json: a scene file;\n- writes a scene file to the standard output");
}

// `bihive scene save` is one command: see with_plain_words().
void add_scene_save(CLI::App& app, SceneSaveOptions& options, Request& request) {
  CLI::App& command =
      add_command(app, kSceneSave, "Write the request for a picture, with all its options, into a scene file",
                  "bihive scene save ligand.json data/1hpv.pdb --style illustrative --fit 'resname 478'",
                  "bihive scene save figure.json figure.png", options, request);
  command.add_option("SCENE", options.picture.output, "The scene file, *.json; - is the standard output")
      ->type_name("FILE")
      ->required();
  add_input<PictureRequest>(command, options.picture);
  add_options_by_theme(command, options.picture, /*without=*/{}, /*with_json=*/false);
}

void add_info(CLI::App& app, InfoOptions& options, Request& request) {
  CLI::App& command = add_command(app, "info", "Show the content of an input and how it was read", "bihive info demo",
                                  "bihive info scenario1 --count 1000000 --radius 0.1 --json", options, request);
  add_input(command, options.input);
  CLI::Option* attributes = command.add_flag("--attributes", options.attributes,
                                             "List what is known of each sphere: ranges and distinct texts");
  CLI::Option* frames =
      command.add_flag("--frames", options.frames,
                       "Read all frames: numbers of spheres, ranges of positions, cell, time, step and\n"
                       "numbers");
  frames->excludes(attributes);
  command.add_flag("--trees", options.trees, "Predict the memory of the trees too, and name the instruction set")
      ->excludes(attributes)
      ->excludes(frames);
  const auto add_measure = [&](const char* name, std::vector<std::string>& texts, const char* help, const char* type) {
    CLI::Option* measure = command.add_option(name, texts, help)->type_name(type)->allow_extra_args(false);
    for (CLI::Option* other : {attributes, frames, command.get_option("--trees")}) measure->excludes(other);
  };
  add_measure("--distance", options.distances,
              "Distance of two spheres in each frame, as CSV: their positions from 0, by the\n"
              "nearest images of a periodic cell (--no-periodic: as they lie); repeatable",
              "I,J");
  add_measure("--angle", options.angles, "Angle at the second of three spheres, degrees; the same", "I,J,K");
  add_measure("--dihedral", options.dihedrals, "Dihedral angle of a chain of four, -180 to 180; the same", "I,J,K,L");
  command.add_flag("--keep-index", options.keep_index, "Text: keep the offsets of the frames in FILE.bihive-index")
      ->needs(frames);
  add_tree_options(command, options.tree);
  add_input_options(command, options.input);
  frames->excludes(command.get_option("--frame"));
  for (CLI::Option* other : {attributes, frames})
    for (const char* name : {"--max-prims", "--max-depth"}) other->excludes(command.get_option(name));
  add_json_flag(command, options.json);
}

void add_select(CLI::App& app, SelectOptions& options, Request& request) {
  CLI::App& command = add_command(app, "select", "Count and list the spheres that an expression selects",
                                  "bihive select demo 'chain A and name CA'",
                                  "bihive select demo 'within 5 of resname 478' --json", options, request);
  add_input(command, options.input, /*alone=*/false);
  command.add_option("EXPRESSION", options.expression, "The selection: docs/selections.md")->type_name("")->required();
  add_input_options(command, options.input);
  add_json_flag(command, options.json);
}

void add_measure(CLI::App& app, MeasureCommandOptions& options, Request& request) {
  CLI::App& command =
      add_command(app, "measure", "Compute area and volume of the union of all spheres, exactly",
                  "bihive measure demo --probe 1.4 --by chain",
                  "bihive measure data/1hpv.pdb --select protein --per-sphere areas.csv", options, request);
  add_input(command, options.input);
  add_value(command, "--probe", options.probe, "R",
            "Add this to every radius: 1.4 A gives the solvent-accessible surface (0)",
            [](const std::string& text) -> Result<double> {
              const auto probe = parse_double(text);
              if (!probe || !(*probe >= 0 && *probe <= 1e30)) return unexpected("a number of at least 0", text);
              return *probe;
            });
  command.add_option("--select", options.select, "Only these spheres exist: docs/selections.md")->type_name("EXPR");
  command.add_option("--by", options.by, "Sums for each value of a column: chain, mol, resname, element ...")
      ->type_name("COLUMN");
  command
      .add_option("--group", options.groups,
                  "A group of spheres: docs/selections.md. Twice or more: the area that each two\nbury between them")
      ->type_name("EXPR")
      ->allow_extra_args(false);
  std::vector<CLI::Option*> tables;
  const auto add_table = [&](const char* name, std::string& target, const char* help) {
    tables.push_back(command.add_option(name, target, help)->type_name("FILE"));
  };
  add_table("--per-sphere", options.per_sphere, "CSV: exposed area, and volume, of each sphere");
  add_table("--cavities", options.cavities, "CSV: volume, area, spheres and residues of each cavity");
  add_table("--contacts", options.contacts, "CSV: each two spheres that share a part of their plane, and its area");
  add_table(
      "--buried", options.buried,
      "CSV: a matrix of the areas that groups bury (of --group, else of --by); on the\ndiagonal each group alone");
  CLI::Option* const frames = command.add_flag("--frames", options.frames, "A row for each frame, as CSV");
  for (CLI::Option* other : tables) frames->excludes(other);
  for (const char* name : {"--by", "--group"}) frames->excludes(command.get_option(name));
  add_threads(command, options.threads);
  add_input_options(command, options.input);
  frames->excludes(command.get_option("--frame"));
  add_json_flag(command, options.json);
}

void add_convert(CLI::App& app, ConvertOptions& options, Request& request) {
  CLI::App& command = add_command(app, "convert", "Write the spheres as they were read into a file of another format",
                                  "bihive convert data/1hpv.pdb -o protein.csv",
                                  "bihive convert demo -o calphas.extxyz --select 'name CA'", options, request);
  add_input(command, options.input);
  add_path(command, "-o,--output", options.output, "The file; - is the standard output");
  add_value(command, "--format", options.format, "xyz|extxyz|csv|npy|ply|sdf|mol2|scene",
            "What to write (by the output's ending: .xyz .extxyz .csv .npy .ply .sdf .mol .mol2 .json)",
            [](const std::string& text) -> Result<std::string> {
              static constexpr const char* formats[] = {"xyz", "extxyz", "csv", "npy", "ply", "sdf", "mol2", "scene"};
              for (const char* format : formats)
                if (text == format) return text;
              return unexpected("xyz, extxyz, csv, npy, ply, sdf, mol2 or scene", text);
            });
  command.add_option("--select", options.select, "Only these spheres: docs/selections.md")->type_name("EXPR");
  add_input_options(command, options.input);
  add_json_flag(command, options.json);
}

void add_thesis(CLI::App& app, ThesisOptions& options, Request& request) {
  CLI::App& command =
      add_command(app, "thesis", "Reproduce the thesis's tables and figures", "bihive thesis all --out report",
                  "bihive thesis table-4.2 figure-4.3 --out report --quick", options, request);
  std::string all;
  for (const std::string& each : thesis_experiments()) all += (all.empty() ? "" : ", ") + each;
  command.add_option("EXPERIMENT", options.experiments, "One or several of, or all if none is named:\n" + all)
      ->type_name("")
      ->check([all](const std::string& name) {
        for (const std::string& each : thesis_experiments())
          if (name == each) return std::string();
        return "there is no experiment \"" + name + "\"; there are " + all;
      });
  CLI::Option* const out = command
                               .add_option("--out", options.out,
                                           "Folder of report.html, results.json, pictures and charts; a run that was\n"
                                           "interrupted goes on where it stopped. Required but with --page")
                               ->type_name("DIR");
  command
      .add_option("--page", options.page,
                  "Write the page that measures a phone: one file to send there, which opens\n"
                  "without a network; what it saves is for --device")
      ->type_name("FILE")
      ->excludes(out);
  command.final_callback([&options, &request] {
    if (options.out.empty() && options.page.empty()) throw CLI::RequiredError("--out");
    request = options;
  });
  command.add_flag("--quick", options.quick, "Everything small: within a minute on two cores");
  add_value(command, "--seed", options.seed, "S", "Seed of the random scenarios (1)", seed_from);
  add_threads(command, options.threads);
  command
      .add_option("--costs", options.costs,
                  "Figure 4.4: judge all claims at these costs: an inner node in sphere tests,\na leaf in inner nodes, "
                  "the fixed part of a ray in sphere tests")
      ->type_name("INNER,LEAF,FIXED")
      ->delimiter(',')
      ->expected(3)
      ->check(CLI::Range(0.0, 1e6));
  command.add_option("--values", options.values, "Other values to compare with: DIR/EXPERIMENT/values.json")
      ->type_name("DIR");
  command
      .add_option("--device", options.devices,
                  "A run or frames shown, saved by the page on another device;\nmay come several times")
      ->type_name("FILE")
      ->allow_extra_args(false);
  add_json_flag(command, options.json);
}

void add_web(CLI::App& app, WebOptions& options, Request& request) {
  CLI::App& command =
      add_command(app, "web", "Serve the page that shows spheres in a browser", "bihive web molecule.pdb",
                  "bihive web scenario2 --port 8080 --no-browser", options, request);
  command.add_option("INPUT", options.shown.input.input, "A file or a built-in name to open (demo)")->type_name("");
  add_trajectory<PictureRequest>(command, options.shown);
  add_integer(command, "--port", options.port, 0, kLargestPort,
              "Port (8017, or the next one that is free; 0: any that is free)");
  add_value(command, "--bind", options.bind, "ADDRESS",
            "Serve this machine's address, so that a phone on the network can\n"
            "open the page; 0.0.0.0: all of them (127.0.0.1: this machine only)",
            address_from);
  command.add_flag_callback(
      "--no-browser", [&options] { options.browser = false; }, "Open no browser");
  command.add_flag("--json", options.json, "Print the addresses as one JSON object in a line");
  CLI::Option* const html = command
                                .add_option("--html", options.html,
                                            "Serve nothing: write the page and its input into one file,\n"
                                            "which opens without a network, on a phone too")
                                ->type_name("FILE");
  for (const char* name : {"--port", "--bind", "--no-browser", "--json"}) html->excludes(command.get_option(name));
  begin_theme(command, "What the page shows first");
  // The page's scenarios have one seed.
  add_options_to_show(command, options.shown, /*of_page=*/true, {"seed"});
}

std::string version_text() {
  return "bihive " + version_with_commit(version(), commit());
}

// The arguments from the last to the first, as CLI11 wants them. It would take the argument after "--title=" for the
// title.
std::vector<std::string> words_for_parser(int argc, const char* const* argv) {
  std::vector<std::string> words;
  bool options = true;
  for (int i = 1; i < argc; ++i) {
    std::string word = argv[i];
    options = options && word != "--";
    const bool is_empty = options && word.rfind("--", 0) == 0 && word.find('=') + 1 == word.size();
    if (is_empty) word.pop_back();
    words.push_back(std::move(word));
    if (is_empty) words.emplace_back();
  }
  std::reverse(words.begin(), words.end());
  return words;
}

// `with_film`: the arguments of a film are among them.
Request parse_words(int argc, const char* const* argv, bool with_film, const Describe& describe) {
  CLI::App app("bihive: ray tracing of spheres on a bounding interval hierarchy", "bihive");
  app.set_version_flag("--version", version_text());
  app.get_formatter()->column_width(34);
  app.footer("bihive COMMAND --help shows a command's options and two examples.");
  app.require_subcommand(0, 1);
  app.set_help_all_flag("--help-all", "Print this help message with all options and exit");

  RenderOptions render;
  AgainOptions again;
  VerifyOptions verify;
  FilmOptions film;
  ViewOptions view;
  StatsOptions stats;
  CompareOptions compare;
  TuneCommandOptions tune;
  TraceOptions trace;
  SceneOptions scene;
  SceneSaveOptions scene_save;
  InfoOptions info;
  StylesOptions styles;
  SelectOptions select;
  MeasureCommandOptions measure;
  ConvertOptions convert;
  ThesisOptions thesis;
  WebOptions web;
  Request request = HelpText{"", false};
  // The options of the named command alone: those of all take most of the time of a short call. Without one, all
  // commands are there, for --help and for the manual pages.
  const std::pair<std::string_view, std::function<void()>> commands[] = {
      {"render", [&] { add_render(app, render, request); }},
      {"again", [&] { add_again(app, again, request); }},
      {"verify", [&] { add_verify(app, verify, request); }},
      {"film", [&] { add_film(app, film, request, argc, argv); }},
      {"view", [&] { add_view(app, view, request); }},
      {"stats", [&] { add_stats(app, stats, request); }},
      {"compare", [&] { add_compare(app, compare, request); }},
      {"tune", [&] { add_tune(app, tune, request); }},
      {"trace", [&] { add_trace(app, trace, request); }},
      {"scene", [&] { add_scene(app, scene, request); }},
      {kSceneSave, [&] { add_scene_save(app, scene_save, request); }},
      {"info", [&] { add_info(app, info, request); }},
      {"styles", [&] { add_styles(app, styles, request); }},
      {"select", [&] { add_select(app, select, request); }},
      {"measure", [&] { add_measure(app, measure, request); }},
      {"convert", [&] { add_convert(app, convert, request); }},
      {"thesis", [&] { add_thesis(app, thesis, request); }},
      {"web", [&] { add_web(app, web, request); }}};
  const std::string_view named = argc > 1 ? argv[1] : "";
  const bool is_named = std::ranges::any_of(commands, [&](const auto& command) { return command.first == named; });
  for (const auto& [name, add] : commands)
    if (!is_named || name == named) add();
  // Manual pages and completions, for the build: --help does not list it.
  if (describe && argc > 1 && std::string(argv[1]) == "describe")
    return HelpText{describe(app, {argv + 2, argv + argc}), true};
  try {
    app.parse(words_for_parser(argc, argv));
  } catch (const CLI::CallForVersion&) {
    return HelpText{version_text() + "\n", true};
  } catch (const CLI::Success& asked) {
    // The help of the requested sub-command, if any.
    const bool all = dynamic_cast<const CLI::CallForAllHelp*>(&asked) != nullptr;
    for (CLI::App* command : app.get_subcommands()) {
      if (!all) shorten_help(*command);
      return HelpText{command->help("bihive"), true};
    }
    return HelpText{app.help(), true};
  } catch (const CLI::ParseError& error) {
    const std::string first = argc > 1 ? argv[1] : "";
    if (app.get_subcommands().empty() && !first.empty() && first.front() != '-')
      fail_usage("there is no command '" + first + "'", "see bihive --help");
    std::string command = "bihive";
    for (const CLI::App* called : app.get_subcommands()) command += " " + called->get_name();
    // CLI11 says "At Most 1 required" for a repeated option.
    std::string what = error.what();
    const std::size_t repeated = what.find(": At Most 1 required but received ");
    if (repeated != std::string::npos) what = what.substr(0, repeated) + " is given more than once";
    if (with_film && repeated != std::string::npos)
      fail_usage(what + ": here, and in the film's options", "leave it out here");
    const CLI::App* const called = app.get_subcommands().empty() ? nullptr : app.get_subcommands().front();
    const std::vector<std::string> unknown = called != nullptr ? called->remaining() : std::vector<std::string>();
    const std::string advice = advice_on(called, unknown, "see " + command + " --help");
    fail_with_option(what, advice);
    fail_usage(what, advice);
  }
  if (std::holds_alternative<HelpText>(request)) return HelpText{app.help(), false};
  return request;
}

// The options of each picture in the description of a film. They are data from a file: each must be an option of a
// picture, with a value that the command line would accept, and may open no file that the user does not name here too.
std::vector<std::string> words_of_film(const std::string& path, int argc, const char* const* argv) {
  const FilmPlan plan = read_film_plan(path);
  const auto refuse = [&](const std::string& what, const std::string& hint) {
    fail({"its options " + what, path, 0, 0, hint});
  };
  CLI::App app;
  FilmOptions film;
  Request request = HelpText{"", false};
  add_film(app, film, request, argc, argv);
  const CLI::App& command = *app.get_subcommand("film");
  const std::vector<GivenOption> given_here = given_options(command, {argv + 2, argv + argc});

  std::vector<std::string> words;
  for (const GivenOption& given : given_options(command, plan.asked.options)) {
    if (!is_of_picture(given))
      refuse("contain " + given.words.front() + ", which is not an option of a picture",
             "take the description that bihive film wrote");
    if (names_file(given)) {
      // The user's own argument is on the command line already.
      const bool is_named = std::any_of(given_here.begin(), given_here.end(), [&](const GivenOption& here) {
        return here.option == given.option && here.value == given.value;
      });
      if (is_named) continue;
      refuse("name the file " + given.value + " (" + given.name + ")",
             "if you trust it, give " + given.name + " " + given.value + " on the command line too");
    }
    words.insert(words.end(), given.words.begin(), given.words.end());
  }

  // Their values, before the user's own arguments are added.
  std::vector<const char*> alone{argv[0], "film", "-o", "x.y4m", "demo"};
  for (const std::string& word : words) alone.push_back(word.c_str());
  try {
    parse_words(static_cast<int>(alone.size()), alone.data(), /*with_film=*/false, {});
  } catch (const Failure& failure) {
    refuse("are invalid: " + failure.error.message, "take the description that bihive film wrote");
  }
  return words;
}

// --wrap is a flag, but for "--wrap molecules" and "--wrap=molecules", which are the flag --wrap-molecules. The command
// "scene save" is one word.
std::vector<const char*> with_plain_words(int argc, const char* const* argv) {
  std::vector<const char*> words;
  bool options = true;
  const bool saves = argc > 2 && std::string_view(argv[1]) == "scene" && std::string_view(argv[2]) == "save";
  if (saves) words = {argv[0], kSceneSave};
  for (int i = saves ? 3 : 0; i < argc; ++i) {
    const std::string_view word = argv[i];
    options = options && word != "--";
    const bool two_words = word == "--wrap" && i + 1 < argc && std::string_view(argv[i + 1]) == "molecules";
    const bool wraps_molecules = options && (two_words || word == "--wrap=molecules");
    words.push_back(wraps_molecules ? "--wrap-molecules" : argv[i]);
    if (wraps_molecules && two_words) ++i;
  }
  return words;
}

}  // namespace

Request parse_command_line(int given_count, const char* const* given, const Describe& describe) {
  const std::vector<const char*> plain = with_plain_words(given_count, given);
  const auto argc = static_cast<int>(plain.size());
  const char* const* const argv = plain.data();
  Request request = parse_words(argc, argv, /*with_film=*/false, describe);
  const RenderOptions* const render = std::get_if<RenderOptions>(&request);
  if (render == nullptr) return request;
  if (render->film.empty()) {
    if (render->picture_of_film) fail_usage("--picture is for --film", "leave it out, or name the film's FILE.json");
    return request;
  }
  // A picture of a film has the film's options, and those that are given here after them.
  const std::vector<std::string> of_film = words_of_film(render->film, argc, argv);
  std::vector<const char*> words{argv[0], argv[1]};
  words.reserve(words.size() + of_film.size() + static_cast<std::size_t>(argc));
  for (const std::string& word : of_film) words.push_back(word.c_str());
  words.insert(words.end(), argv + 2, argv + argc);
  return parse_words(static_cast<int>(words.size()), words.data(), /*with_film=*/true, {});
}

}  // namespace bihive::cli
