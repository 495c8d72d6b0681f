// bihive-mpi render --distribute: each rank gets some of the spheres. Rank 0 reads them, or each rank reads a chunk.

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bihive/base/setting_name.h"
#include "bihive/base/timer.h"
#include "bihive/io/data_path.h"
#include "bihive/job/choose_look.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "bihive/job/prepare_picture.h"
#include "bihive/render/frame_picture.h"
#include "bihive/scene/load_scene.h"
#include "bihive/spread/read_chunk.h"
#include "bihive/spread/spread_scene.h"
#include "commands/distributed_options.h"
#include "commands/draw_spread.h"
#include "commands/render_steps.h"
#include "commands/share_picture.h"
#include "support/communicator.h"
#include "support/interrupt.h"

namespace bihive::cli {
namespace {

// Chunks of the file give the picture of the whole one only if nothing but centres and radii matters.
bool reads_chunks(const RenderOptions& options, ReadingByRanks reading) {
  const std::string& input = options.input.input;
  if (reading == ReadingByRanks::whole || is_built_in_scene(input) || !data_path(input).inside.empty()) return false;
  const Style style = choose_style(options.style);
  constexpr std::array kNumbersOfAll{"x", "y", "z", "r", "radius"};
  const auto& by = style.colour_by;
  const bool plain_colours =
      !by || (std::find(kNumbersOfAll.begin(), kNumbersOfAll.end(), by->attribute) != kNumbersOfAll.end() &&
              by->map != ColourMap::okabe_ito);
  return plain_colours && !style.density && style.picture.fit_share == 1 && !style.picture.labels.legend &&
         can_read_chunks_of(file_of(options.input));
}

// The spheres of this rank, with facts about all.
LoadedPicture load_chunk(const RenderOptions& options, Style& style, Communicator& ranks) {
  LoadedPicture loaded;
  WholeSet& whole = loaded.whole.emplace();
  loaded.input = load_file(options.input, [&](const ReadOptions& reading) -> Result<Input> {
    Result<ReadChunk> chunk = read_chunk(options.input.input, reading, ranks);
    if (!chunk) return chunk.error();
    whole.count = chunk->whole_count;
    whole.bounds = chunk->whole_bounds;
    if (style.colour_by) take_whole_range(chunk->file.spheres, *style.colour_by, ranks);
    return scene_of_spheres(std::move(chunk->file), options.input.input, &style);
  });
  whole.frame = [&options, &ranks, bounds = whole.bounds](const Scene& scene, const Side& side, const Lens& lens,
                                                          const RenderSettings& settings) {
    return settings.view == View::tree ? frame_picture(scene, side, lens, settings)  // refuse() says so
                                       : frame_whole_picture(scene, bounds, side, lens, settings, ranks);
  };
  return loaded;
}

void refuse(const PreparedPicture& prepared) {
  if (const Status status = SpreadScene::refusal(prepared.input.scene, prepared.settings); !status)
    fail_setting("distribute", ": " + status.error().message, status.error().hint);
  if (prepared.engine != RenderEngine::automatic && prepared.engine != RenderEngine::wide)
    fail_usage("distributed spheres are drawn by the engine wide alone", "leave " + setting_name("engine") + " out");
}

}  // namespace

void run_render_spread(const RenderOptions& options) {
  PictureCommunicator& ranks = *communicator();
  const ReadingByRanks reading = [&] {
    const Result<ReadingByRanks> known = reading_by_ranks(options);
    if (!known) fail_usage(known.error().message, known.error().hint);
    return *known;
  }();
  const bool in_chunks = ranks.broadcast_value(leads() && reads_chunks(options, reading));
  PreparedPicture prepared{};
  if (leads() || in_chunks) {
    prepared = in_chunks ? prepare_render(options, [&](Style& style) { return load_chunk(options, style, ranks); })
                         : prepare_render(options);
    refuse(prepared);
  }
  prepared.settings.threads = static_cast<int>(options.threads);
  ranks.barrier();
  if (!in_chunks) share_picture(prepared, /*with_spheres=*/false, ranks);

  // Each rank builds a tree of its spheres.
  const std::vector<std::pair<std::string, std::string>> text =
      text_of(options, prepared.input.scene, prepared.described);
  const std::shared_ptr<const SpreadScene> spread =
      value_or_fail(SpreadScene::make(std::move(prepared.input.scene), prepared.settings, options.tree, ranks));
  const Timer drawing;
  RenderSettings of_file = prepared.settings;
  of_file.threads = 1;
  const std::unique_ptr<TileChannel> channel =
      ranks.open_channel([&](const Bytes& question) { return spread->answer(question); }, prepared.settings.threads);
  const std::unique_ptr<SpreadScene::Artist> artist = spread->artist(*channel);
  prepared.input.scene = artist->scene();  // for the report
  const std::unique_ptr<PictureFile> file =
      leads() ? open_picture({options, artist->scene(), artist->tracer(), of_file, prepared.layers, text}) : nullptr;
  // Nothing may fail between this and the drawing.
  ranks.barrier();
  channel->begin();
  const Drawn drawn = [&] {
    const CancellableSection section;
    Progress progress("rendering");
    const auto update = [&](double done) { progress.update(done); };
    try {
      if (prepared.can_share) return draw_spread(*spread, prepared.settings, file.get(), update, ranks, *channel);
      return draw_spread_alone(*artist, prepared.engine, prepared.settings, prepared.layers, file.get(), update,
                               *channel);
    } catch (const Interrupted&) {
      CancellableSection::leave_if_cancelled();
      throw;
    }
  }();
  ranks.barrier();
  if (file == nullptr) return;
  value_or_fail(file->finish());
  const double write_ms = drawing.elapsed_ms() - drawn.render_ms;
  report_render(options, {prepared, Engine::wide, spread->whole_size(), spread->build_ms(), write_ms, drawn, *file});
}

}  // namespace bihive::cli
