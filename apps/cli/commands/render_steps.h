// The steps of bihive render that it shares with pictures of distributed spheres.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bihive/job/choose_camera.h"
#include "bihive/render/layers.h"
#include "bihive/scene/render_settings.h"
#include "commands/commands.h"
#include "commands/draw_picture.h"
#include "commands/picture_file.h"

namespace bihive::cli {

/// The input with the user's options, and the text about them in its file.
struct PreparedPicture {
  RenderEngine engine;
  Input input;
  RenderSettings settings;
  std::vector<Layer> layers;
  nlohmann::ordered_json described;
  bool can_share;  ///< else rank 0 draws alone: other engines, layers without light, some views
  double read_ms;
};

/// An input in this style, and facts about all its spheres if it has only a chunk of them.
struct LoadedPicture {
  Input input;
  std::optional<WholeSet> whole = {};
};
using LoadPicture = std::function<LoadedPicture(Style& style)>;

/// The options of the film are applied already. Fails like the steps that it calls. `load`: replaces load_input().
PreparedPicture prepare_render(const RenderOptions& options, const LoadPicture& load = {});
/// Merges the film's options, or those of an input that is a saved request, into a picture's.
RenderOptions with_film(const RenderOptions& asked);

/// A drawn picture, for the report.
struct FinishedPicture {
  const PreparedPicture& prepared;
  Engine engine;
  std::int64_t spheres;
  double build_ms, write_ms;
  const Drawn& drawn;
  const PictureFile& file;
};
void report_render(const RenderOptions& options, const FinishedPicture& finished);

/// bihive-mpi with --distribute: each rank has some of the spheres. `options`: from with_film().
void run_render_spread(const RenderOptions& options);

}  // namespace bihive::cli
