// bihive-mpi render --distribute: rank 0 reads, and each rank gets some of the spheres.

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "bihive/base/timer.h"
#include "bihive/spread/scene_bytes.h"
#include "bihive/spread/spread_scene.h"
#include "commands/draw_spread.h"
#include "commands/draw_with_team.h"
#include "commands/picture_settings.h"
#include "commands/render_steps.h"
#include "support/failure.h"
#include "support/interrupt.h"
#include "support/messages.h"
#include "support/team.h"

namespace bihive::cli {
namespace {

void refuse(const PreparedPicture& prepared) {
  if (prepared.engine != RenderEngine::automatic && prepared.engine != RenderEngine::wide)
    fail_usage("distributed spheres are drawn by the engine wide alone", "leave --engine out");
  if (const Status status = SpreadScene::refusal(prepared.input.scene, prepared.settings); !status)
    fail_usage("--distribute: " + status.error().message, status.error().hint);
}

// All that rank 0 knows of the picture but for the spheres: on rank 0 given, on the others taken.
void share(PreparedPicture& prepared, Team& team) {
  Bytes own;
  if (leads()) {
    ByteWriter out(own);
    out.put_text(prepared.described.dump());
    out.put(can_share(prepared));
    put_scene(prepared.input.scene, prepared.settings, own);
  }
  const std::vector<Bytes> all = team.gather(own);
  if (leads()) return;
  ByteReader in(all.front());
  prepared.described = nlohmann::ordered_json::parse(in.take_text());
  // What another rank cannot share has no layers of its own to tell.
  if (!in.take<bool>()) prepared.layers = {Layer{LayerKind::depth, {}}};
  const int threads = prepared.settings.threads;
  take_scene(in, prepared.input.scene, prepared.settings);
  prepared.settings.threads = threads;
}

}  // namespace

void run_render_spread(const RenderOptions& options) {
  Team& ranks = *team();
  PreparedPicture prepared{};
  if (leads()) {
    prepared = prepare_render(options);
    refuse(prepared);
  }
  prepared.settings.threads = static_cast<int>(options.threads);
  ranks.agree({fingerprint_of_program()});
  share(prepared, ranks);

  // Each rank builds a tree of its spheres.
  const std::vector<std::pair<std::string, std::string>> text = text_of(prepared.input.scene, prepared.described);
  const std::shared_ptr<const SpreadScene> spread = value_or_fail(
      SpreadScene::make(std::move(prepared.input.scene), prepared.settings, options.tree, ranks));
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
      if (can_share(prepared))
        return draw_spread(*spread, prepared.settings, file.get(), update, ranks, *conversation);
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
  report_render(options,
                {prepared, Engine::wide, spread->whole_size(), spread->build_ms(), write_ms, drawn, *file});
}

}  // namespace bihive::cli
