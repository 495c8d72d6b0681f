// The sub-commands: their options, each parsed and checked, and the functions that run them. These return, or end by a
// Failure (failure.h).
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bihive/compare/query_sets.h"
#include "bihive/job/picture_request.h"
#include "bihive/render/layers.h"
#include "bihive/scene/camera_path.h"
#include "bihive/scene/frame_range.h"
#include "bihive/thesis/experiments.h"
#include "bihive/viewer/viewer_settings.h"
#include "film/picture_order.h"

namespace bihive::cli {

/// A picture, and its file.
struct RenderOptions : PictureRequest {
  std::string output;  ///< a path, or "-": the standard output
  std::optional<std::vector<Layer>> layers;
  bool as_exr = false;  ///< OpenEXR, whatever the output's name
  bool json = false;
  bool metadata = true;  ///< the file says how it was made
  bool methods = false;  ///< print methods_text() too
  std::string film;      ///< the file that describes a film, of which this is a picture; empty: none
  std::optional<std::int64_t> picture_of_film;  ///< from 0; unset: by input.frame
};
void run_render(const RenderOptions& options);

/// The picture of a figure that bihive drew, once more, with changes.
struct AgainOptions {
  std::string figure;
  RenderOptions changes;  ///< its input: in place of the figure's; its output empty: by the figure's name
};
void run_again(const AgainOptions& options);

/// Draws figures again and compares.
struct VerifyOptions {
  std::vector<std::string> figures;  ///< files, or folders: all pictures in them that bihive drew
  std::string input;                 ///< in place of the figure's; empty: that
  std::string difference;            ///< a picture of where they differ; empty: none
  bool methods = false;              ///< print methods_text() of each instead
  bool json = false;
};
/// False: some figure is not what its record says.
bool run_verify(const VerifyOptions& options);

/// Pictures per second: a fraction, so that 30000/1001 is exact.
struct FrameRate {
  std::int64_t pictures = 25, seconds = 1;
};
/// "25", "29.97" or "30000/1001", above 0.
Result<FrameRate> frame_rate_from(const std::string& text);

/// Every `count`-th picture of a film, from picture `index` on.
struct Shard {
  std::int64_t index = 0, count = 1;
};
/// "i/N" with 0 <= i < N.
Result<Shard> shard_from(const std::string& text);

/// The frames that give the colours of numbers their range.
enum class RangeOfColours { first, film, frame };

/// The frames whose spheres a camera that bihive places brings into the picture: the first shown one, all of them, or
/// in each picture those of its own frame.
enum class FittedFrames { first, all, each };

/// Milliseconds of each step, summed over the pictures. The steps run concurrently.
struct FilmTimes {
  double read_ms = 0;   ///< from the file to spheres
  double build_ms = 0;  ///< looks and trees
  double trace_ms = 0;  ///< rays, labels and pixels
  double write_ms = 0;  ///< files, or the wait for ffmpeg
  std::int64_t pictures = 0;

  void add(const FilmTimes& more) {
    read_ms += more.read_ms;
    build_ms += more.build_ms;
    trace_ms += more.trace_ms;
    write_ms += more.write_ms;
    pictures += more.pictures;
  }
};

struct FilmOptions {
  RenderOptions picture;           ///< of every picture; its output is the film's
  std::vector<std::string> words;  ///< the options of a picture, as on the command line
  std::optional<FrameRange> frames;
  std::optional<std::int64_t> pictures;  ///< of one frame
  PictureOrder order;
  FrameRate rate;
  double turntable_deg = 0;
  std::string turn_axis;      ///< "x", "y", "z" or "picture"; empty: the world's up
  std::string follow, align;  ///< selections; empty: none
  FittedFrames fit_frames = FittedFrames::first;
  std::string camera_keys;      ///< a file; empty: none
  std::vector<CameraKey> keys;  ///< without a file
  RangeOfColours range_of_colours = RangeOfColours::first;
  std::string codec;  ///< ffmpeg's options for the film's codec, separated by single spaces; empty: by the output's
                      ///< ending
  std::optional<Shard> shard;
  bool join = false;
  bool silent = false;  ///< no report: another process reports on the film
  FilmTimes of_shards;  ///< with join: the times of the processes that made the shards
  double ms_of_shards = 0;
};
/// Returns statistics.
FilmTimes run_film(const FilmOptions& options);

struct StylesOptions {
  bool json = false;
};
void run_styles(const StylesOptions& options);

/// The window, and its content. Unset: the scene's value.
struct ViewOptions : PictureRequest {
  std::optional<PictureSize> size;  ///< of the window
  std::optional<ViewerEngine> window_engine;
  std::string card;        ///< id of viewer/cards.h; empty: none is open at first
  std::string screenshot;  ///< empty: none
};
/// Becomes bihive-view, the program with the window; returns only by a Failure.
[[noreturn]] void run_view(const ViewOptions& options);

struct StatsOptions {
  InputOptions input;
  TreeParameters tree;
  bool json = false;
};
void run_stats(const StatsOptions& options);

/// Structures compared by name (bihive/compare/structure.h).
struct CompareOptions {
  InputOptions input;
  std::string select;                        ///< only these spheres; empty: all
  std::vector<std::string> structures;       ///< empty: all
  std::vector<workbench::QueryKind> kinds;   ///< empty: all
  std::int64_t count = 65536;                ///< queries of a kind
  std::vector<int> threads{1, 0};            ///< a sweep and the path of a pixel's ray take the first one
  std::vector<std::string> sweep;            ///< parameters with values: "max-prims=1,2,4"
  std::optional<std::pair<int, int>> pixel;  ///< x, y of the primary picture: only the path of its ray
  bool boxes = false;                        ///< the input is a file of boxes, not of spheres
  std::string universe;                      ///< with `boxes`: of a geometry of ORANGE; empty: the first
  std::string output;                        ///< the report, HTML; empty: none
  bool json = false;
};
/// With `boxes`.
void run_compare_boxes(const CompareOptions& options);
void run_compare(const CompareOptions& options);

/// Parameters of a tree searched (bihive/compare/tune.h).
struct TuneCommandOptions {
  InputOptions input;
  std::string select;  ///< only these spheres; empty: all
  std::string structure = "wide";
  std::vector<workbench::QueryKind> kinds;  ///< empty: all
  std::int64_t count = 4096;                ///< queries of a kind
  std::int64_t threads = 1;
  bool json = false;
};
void run_tune(const TuneCommandOptions& options);

struct TraceOptions {
  InputOptions input;
  std::string rays, t, id;  ///< paths
  bool any = false;
  bool plane = false;
  Engine engine = Engine::automatic;
  TreeParameters tree;
  bool tune = false;
  std::int64_t threads = 0;
};
void run_trace(const TraceOptions& options);

struct SceneOptions {
  InputOptions input;
  std::string output;
};
void run_scene(const SceneOptions& options);

/// Writes the request for a picture into a scene file.
struct SceneSaveOptions {
  RenderOptions picture;  ///< its output is the scene file; its input may be a figure
};
void run_scene_save(const SceneSaveOptions& options);

struct InfoOptions {
  InputOptions input;
  TreeParameters tree;
  bool attributes = false;                                ///< only the attributes of spheres
  bool frames = false;                                    ///< the content of all frames
  bool trees = false;                                     ///< in the text, the predicted memory of the trees too
  bool keep_index = false;                                ///< the index of the frames, beside the file
  std::vector<std::string> distances, angles, dihedrals;  ///< "0,5": positions of spheres between commas
  bool json = false;

  bool measures() const { return !distances.empty() || !angles.empty() || !dihedrals.empty(); }
};
/// `bihive info --frames`.
void run_info_of_frames(const InfoOptions& options);
/// `bihive info --distance`, `--angle`, `--dihedral`.
void run_info_of_measures(const InfoOptions& options);
void run_info(const InfoOptions& options);
/// `bihive info --attributes`.
void print_attributes(const Input& input, bool as_json);

struct SelectOptions {
  InputOptions input;
  std::string expression;
  bool json = false;
};
void run_select(const SelectOptions& options);

struct MeasureCommandOptions {
  InputOptions input;
  double probe = 0;
  std::string select;               ///< an expression; empty: all spheres
  std::string by;                   ///< a column; empty: no sums by it
  std::string per_sphere;           ///< a CSV file; empty: none
  std::string cavities;             ///< the same
  std::string contacts;             ///< the same
  std::string buried;               ///< the same
  std::vector<std::string> groups;  ///< expressions
  bool frames = false;
  std::int64_t threads = 0;
  bool json = false;
};
void run_measure(const MeasureCommandOptions& options);
void run_measure_frames(const MeasureCommandOptions& options);  ///< measure.cpp has checked the options

struct ConvertOptions {
  InputOptions input;
  std::string output;  ///< a file; "-": the standard output
  std::string format;  ///< a name of kConvertFormats; empty: by the output's ending
  std::string select;  ///< an expression; empty: all spheres
  bool json = false;
};
void run_convert(const ConvertOptions& options);

/// "all", and the experiments in the report's order.
inline const std::vector<std::string>& thesis_experiments() {
#define BIHIVE_ID(name, id, section, title) , id
  static const std::vector<std::string> kNames{"all" BIHIVE_THESIS_EXPERIMENTS(BIHIVE_ID)};
#undef BIHIVE_ID
  return kNames;
}

/// Carried out by the program bihive-thesis, which reads the same command line.
struct ThesisOptions {
  std::vector<std::string> experiments;  ///< names, or "all"; empty: all
  std::string out;                       ///< folder
  std::string page;                      ///< a file for the page that measures a phone; then nothing else is done
  bool quick = false;
  std::uint64_t seed = 1;
  std::int64_t threads = 0;
  std::vector<double> costs;  ///< of Figure 4.4, for all its claims: apps/thesis/experiment.h; empty: fitted ones
  std::string values;         ///< folder of other stated values; empty: the built-in ones
  std::vector<std::string> devices;  ///< runs that the page saved on other devices
  bool json = false;
};

struct WebOptions {
  ViewOptions shown;                 ///< its first state; without input: the page's own
  std::optional<std::int64_t> port;  ///< 0: any free port; unset: the first free port from 8017 on
  std::string bind = "127.0.0.1";    ///< numeric, in its usual spelling
  bool browser = true;
  bool json = false;
  std::string html;  ///< a file for the page with the input inside; then nothing is served
};
void run_web(const WebOptions& options);

/// `bihive thesis --page FILE`: the page that measures Figure 4.4 on a phone, one file with everything.
void write_phone_page(const std::string& file);

}  // namespace bihive::cli
