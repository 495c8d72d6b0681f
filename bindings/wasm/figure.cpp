#include "figure.h"

#include <emscripten/bind.h>

#include <algorithm>
#include <utility>

#include "answers.h"
#include "bihive/base/sha256.h"
#include "bihive/base/version.h"
#include "bihive/io/bundled.h"
#include "bihive/job/choose_look.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "bihive/job/prepare_picture.h"
#include "bihive/job/verdict.h"
#include "bihive/render/finished_pixels.h"
#include "bihive/render/memory.h"
#include "bihive/render/renderer.h"

namespace bihive::page {
namespace {

using nlohmann::ordered_json;

// The progress of a picture is told this often.
constexpr int kBands = 50;

// The library for front ends throws.
template <class Work>
std::string answered(const Work& work) {
  return with_memory([&]() -> std::string {
    try {
      return work();
    } catch (const Failure& failed) {
      return failure(failed.error);
    }
  });
}

void append(PngPixels rows, PngPixels& all) {
  if (all.height == 0) {
    all = std::move(rows);
    return;
  }
  all.bytes.insert(all.bytes.end(), rows.bytes.begin(), rows.bytes.end());
  all.height += rows.height;
}

PngPixels drawn_again(const PictureRequest& request, const emscripten::val& progress) {
  const RenderEngine engine = choose_engine(request);
  if (is_gpu(engine))
    fail({"was drawn by a graphics processor, which this page cannot compare", "", 0, 0, "bihive verify compares it"});
  Style style = choose_style(request.style);
  if (request.fixed) fix_range(style, request.fixed->range_of_style);
  Input input = load_input(request.input, LooksOfFile::keep, &style, !request.style.name.empty());
  const RenderSettings settings = prepare_picture(request, engine, input);
  check_memory_of(engine, input, request, settings);
  const Tile drawn = drawn_pixels(settings);
  value_or_fail(check_picture_memory(drawn.width(), drawn.height()));
  const Tracer tracer = value_or_fail(Tracer::build(input.scene, structure_of(engine), request.tree, settings.threads));
  PngPixels all;
  const auto take = [&](const Film& film, const Tile& band) -> Status {
    RenderSettings of_band = settings;
    of_band.crop = band;
    append(finished_pixels(film, input.scene, of_band, static_cast<int>(request.bits.value_or(8))), all);
    progress(static_cast<double>(band.y1 - drawn.y0) / drawn.height());
    return Done{};
  };
  value_or_fail(render_in_bands(input.scene, tracer, settings, 1 + drawn.height() / kBands, take));
  return all;
}

emscripten::val bundled() {
  const std::string_view bytes = bundled_molecule();
  return emscripten::val(
      emscripten::typed_memory_view(bytes.size(), reinterpret_cast<const std::uint8_t*>(bytes.data())));
}

// Of a file in the module.
std::string sha256_at(const std::string& path) {
  const Result<std::string> digits = sha256_of_file(path);
  return digits ? text_of({{"sha256", *digits}}) : failure(digits.error());
}

}  // namespace

std::string Figure::folder() {
  return std::string(kFolder);
}

std::string Figure::open(const std::string& name, const std::string& record) {
  return answered([&] {
    name_ = name;
    record_ = value_or_fail(picture_record_from(record));
    ordered_json files = ordered_json::array();
    for (const RecordedFile& file : record_.files)
      files.push_back({{"option", file.option}, {"name", file.name}, {"sha256", file.sha256}});
    return text_of({{"drawn_by", version_with_commit(record_.version, record_.commit)},
                    {"scene", record_.built_in},
                    {"is_film", !record_.film.empty()},
                    {"files", files}});
  });
}

std::string Figure::draw(const emscripten::val& progress) {
  return answered([&] {
    std::vector<std::string> warnings;  // of the input; whoever opens it here is told
    const CollectedWarnings collected(warnings);
    std::string place(kFolder);
    place.pop_back();
    again_ = drawn_again(request_again(record_, place, "", {}), progress);
    return std::string("{}");
  });
}

std::string Figure::compare(int width, int height, int channels, int bits, const std::string& pixels) {
  return answered([&] {
    FigurePixels figure, again;
    figure.pixels = {width, height, channels, bits, {pixels.begin(), pixels.end()}};
    again.pixels = std::move(again_);
    Verdict verdict;
    verdict.figure = name_;
    verdict.drawn_by = version_with_commit(record_.version, record_.commit);
    bihive::compare(figure, again, verdict);
    verdict.edited = sha256_of(figure) != record_.pixels_sha256;
    return text_of({{"holds", verdict.holds()}, {"words", judgement_of(verdict)}});
  });
}

}  // namespace bihive::page

EMSCRIPTEN_BINDINGS(figure) {
  using bihive::page::Figure;
  emscripten::function("bundled", &bihive::page::bundled);
  emscripten::function("sha256_at", &bihive::page::sha256_at);
  emscripten::class_<Figure>("Figure")
      .constructor<>()
      .class_function("folder", &Figure::folder)
      .function("open", &Figure::open)
      .function("draw", &Figure::draw)
      .function("compare", &Figure::compare);
}
