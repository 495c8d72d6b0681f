#include "bihive/job/draw_again.h"

#include <utility>

#include "bihive/job/choose_look.h"
#include "bihive/job/failure.h"
#include "bihive/job/prepare_picture.h"
#include "bihive/render/finished_pixels.h"
#include "bihive/render/memory.h"

namespace bihive {
namespace {

// A picture is drawn in this many bands, so that its film is never there as a whole.
constexpr int kBands = 50;

void append(PngPixels rows, PngPixels& all) {
  if (all.height == 0) {
    all = std::move(rows);
    return;
  }
  all.bytes.insert(all.bytes.end(), rows.bytes.begin(), rows.bytes.end());
  all.height += rows.height;
}

}  // namespace

PngPixels draw_again(const PictureRequest& request, const ProgressCallback& progress) {
  const RenderEngine engine = choose_engine(request);
  if (is_gpu(engine))
    fail({"was drawn by a graphics processor, which is not compared here", "", 0, 0, "bihive verify compares it"});

  // Load the scene, and apply the options to it.
  Style style = choose_style(request.style);
  if (request.fixed) fix_range(style, request.fixed->range_of_style);
  Input input = load_input(request.input, LooksOfFile::keep, &style, !request.style.name.empty());
  const RenderSettings settings = prepare_picture(request, engine, input);
  check_memory_of(engine, input, request, settings);
  const Tile drawn = drawn_pixels(settings);
  value_or_fail(check_picture_memory(drawn.width(), drawn.height()));

  // Build and draw.
  const Tracer tracer = value_or_fail(Tracer::build(input.scene, structure_of(engine), request.tree, settings.threads));
  PngPixels all;
  const auto take = [&](const Film& film, const Tile& band) -> Status {
    RenderSettings of_band = settings;
    of_band.crop = band;
    append(finished_pixels(film, input.scene, of_band, static_cast<int>(request.bits.value_or(8))), all);
    return Done{};
  };
  value_or_fail(render_in_bands(input.scene, tracer, settings, 1 + drawn.height() / kBands, take, progress));
  return all;
}

}  // namespace bihive
