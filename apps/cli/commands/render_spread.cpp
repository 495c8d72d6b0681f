// bihive-mpi render --distribute: each rank gets some of the spheres. Rank 0 reads them, or each rank a part.

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "bihive/base/timer.h"
#include "bihive/io/part_of_file.h"
#include "bihive/spread/parts_of_ranks.h"
#include "bihive/spread/spread_scene.h"
#include "commands/choose_look.h"
#include "commands/draw_spread.h"
#include "commands/picture_settings.h"
#include "commands/render_steps.h"
#include "commands/share_picture.h"
#include "support/failure.h"
#include "support/interrupt.h"
#include "support/messages.h"
#include "support/team.h"

namespace bihive::cli {
namespace {

// Parts of the file give the picture of the whole one only where nothing but places and radii matters.
bool reads_parts(const RenderOptions& options) {
  const InputOptions& input = options.input;
  const bool plain_input = input.frame.value_or(0) == 0 && input.trajectory.empty() && input.assembly.empty() &&
                           input.columns.empty() && !input.replicate && !input.cell_vectors && !input.cell_origin &&
                           input.wrapping == Wrapping::none;
  const bool plain_look = options.looks.words.empty() && options.looks.element_colours.empty() &&
                          !options.picture.is_on("legend") && !options.fixed && !options.picture.is_on("cell") &&
                          (!options.focus || std::holds_alternative<double>(*options.focus));
  if (!plain_input || !plain_look || is_built_in_scene(input.input)) return false;
  const Style style = choose_style(options.style);
  constexpr std::array kNumbersOfAll{"x", "y", "z", "r", "radius"};
  const auto& by = style.colour_by;
  const bool plain_colours =
      !by || (std::find(kNumbersOfAll.begin(), kNumbersOfAll.end(), by->attribute) != kNumbersOfAll.end() &&
              by->map != ColourMap::okabe_ito);
  return plain_colours && !style.picture.labels.legend && can_read_part(file_of(input));
}

void refuse(const PreparedPicture& prepared) {
  if (const Status status = SpreadScene::refusal(prepared.input.scene, prepared.settings); !status)
    fail_usage("--distribute: " + status.error().message, status.error().hint);
  if (prepared.engine != RenderEngine::automatic && prepared.engine != RenderEngine::wide)
    fail_usage("distributed spheres are drawn by the engine wide alone", "leave --engine out");
}

}  // namespace

void run_render_spread(const RenderOptions& asked) {
  Team& ranks = *team();
  RenderOptions options = asked;
  const Bytes decided = ranks.from_first(leads() && reads_parts(options) ? Bytes{1} : Bytes{});
  const bool in_parts = !decided.empty();
  if (in_parts) options.input.parts = std::make_shared<PartsOfRanks>(ranks);
  PreparedPicture prepared{};
  if (leads() || in_parts) {
    prepared = prepare_render(options);
    refuse(prepared);
  }
  prepared.settings.threads = static_cast<int>(options.threads);
  ranks.agree({});
  if (!in_parts) share_picture(prepared, /*with_spheres=*/false, ranks);

  // Each rank builds a tree of its spheres.
  const std::vector<std::pair<std::string, std::string>> text = text_of(prepared.input.scene, prepared.described);
  const std::shared_ptr<const SpreadScene> spread =
      value_or_fail(SpreadScene::make(std::move(prepared.input.scene), prepared.settings, options.tree, ranks));
  const Timer drawing;
  RenderSettings of_file = prepared.settings;
  of_file.threads = 1;
  const std::unique_ptr<Conversation> conversation =
      ranks.converse([&](const Bytes& question) { return spread->answer(question); }, prepared.settings.threads);
  const std::unique_ptr<SpreadScene::Artist> artist = spread->artist(*conversation);
  prepared.input.scene = artist->scene();  // for the report
  const std::unique_ptr<PictureFile> file =
      leads() ? open_picture({options, artist->scene(), artist->tracer(), of_file, prepared.layers, text}) : nullptr;
  // Nothing may fail between this and the drawing.
  ranks.agree({});
  conversation->begin();
  const Drawn drawn = [&] {
    const CancellableSection section;
    Progress progress("rendering");
    const auto update = [&](double done) { progress.update(done); };
    try {
      if (prepared.can_share) return draw_spread(*spread, prepared.settings, file.get(), update, ranks, *conversation);
      return draw_spread_alone(*artist, prepared.engine, prepared.settings, prepared.layers, file.get(), update,
                               *conversation);
    } catch (const Interrupted&) {
      CancellableSection::leave_if_cancelled();
      throw;
    }
  }();
  ranks.agree({});
  if (file == nullptr) return;
  value_or_fail(file->finish());
  const double write_ms = drawing.elapsed_ms() - drawn.render_ms;
  report_render(options, {prepared, Engine::wide, spread->whole_size(), spread->build_ms(), write_ms, drawn, *file});
}

}  // namespace bihive::cli
