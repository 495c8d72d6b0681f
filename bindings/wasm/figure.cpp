#include "figure.h"

#include <emscripten/bind.h>

#include <thread>
#include <utility>

#include "answers.h"
#include "bihive/base/sha256.h"
#include "bihive/base/version.h"
#include "bihive/io/bundled.h"
#include "bihive/job/draw_again.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "bihive/job/verdict.h"

namespace bihive::page {
namespace {

using nlohmann::ordered_json;

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
    std::vector<std::string> warnings;  // not shown: opening the input on the page shows them
    const CollectedWarnings collected(warnings);
    std::string place(kFolder);
    place.pop_back();
    // Any thread may report; JavaScript's function is that of this one.
    const auto this_one = std::this_thread::get_id();
    again_ = draw_again(request_again(record_, place, "", {}), [&](double done) {
      if (std::this_thread::get_id() == this_one) progress(done);
    });
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
