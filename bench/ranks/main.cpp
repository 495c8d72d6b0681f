// Counts what a picture costs on many ranks, all of which are simulated in this process.
//   bihive-ranks RANKS[,RANKS...] render INPUT [options of bihive render]
// Prints a JSON array, an object for each number of ranks (README.md). Each rank draws on one thread.
#include <algorithm>
#include <atomic>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "bihive/base/timer.h"
#include "bihive/render/picture_tiles.h"
#include "bihive/render/renderer.h"
#include "bihive/spread/ranks_in_process.h"
#include "command_line.h"
#include "commands/render_steps.h"
#include "support/failure.h"
#include "support/messages.h"

namespace bihive::bench {
namespace {

using nlohmann::ordered_json;

// An exchange that knows how long it took.
class TimedExchange final : public Exchange {
 public:
  explicit TimedExchange(std::unique_ptr<Exchange> exchange) : exchange_(std::move(exchange)) {}
  int rank() const override { return exchange_->rank(); }
  int ranks() const override { return exchange_->ranks(); }
  std::vector<Bytes> ask(std::vector<Question> questions) override {
    const Timer timer;
    std::vector<Bytes> answers = exchange_->ask(std::move(questions));
    ms_ += timer.elapsed_ms();
    return answers;
  }
  double ms() const { return ms_; }

 private:
  std::unique_ptr<Exchange> exchange_;
  double ms_ = 0;
};

// What a rank did of a picture.
struct Drawn {
  double ms = 0;  // without the answers of others
  ExchangeCounts counts;
};

// Draws the tiles of a rank into the film. Tiles are handed out in turn.
Drawn draw(RanksInProcess& ranks, int rank, RenderSettings settings, const PictureTiles& tiles, Film& film) {
  settings.threads = 1;
  TimedExchange exchange(ranks.exchange(rank));
  const Timer timer;
  const std::unique_ptr<SpreadScene::Artist> artist = ranks.scene(rank).artist(exchange);
  const Tile all = drawn_pixels(settings);
  std::int64_t number = rank - ranks.size();
  const auto next = [&]() -> std::optional<Tile> {
    artist->rest();
    number += ranks.size();
    if (number >= tiles.count()) return std::nullopt;
    return tiles.pixels(number);
  };
  const auto take = [&](const Film& tile, const Tile& pixels) -> Status {
    paste(tile, pixels.x0 - all.x0, pixels.y0 - all.y0, film);
    return Done{};
  };
  cli::value_or_fail(render_parts(artist->scene(), artist->tracer(), settings, next, take));
  return {timer.elapsed_ms() - exchange.ms(), artist->counts()};
}

// The mean and the largest of some numbers, one of each rank.
template <class Number>
ordered_json of_ranks(const std::vector<Number>& numbers) {
  const double sum = static_cast<double>(std::accumulate(numbers.begin(), numbers.end(), Number{}));
  return {{"mean", sum / static_cast<double>(numbers.size())},
          {"largest", *std::max_element(numbers.begin(), numbers.end())}};
}

bool same_bits(const Film& a, const Film& b) {
  return a.radiance.size() == b.radiance.size() &&
         std::memcmp(a.radiance.data(), b.radiance.data(), a.radiance.size() * sizeof(Vec3f)) == 0;
}

ordered_json measure(const Scene& scene, const RenderSettings& settings, const TreeParameters& parameters, int count,
                     const Film& expected) {
  const std::unique_ptr<RanksInProcess> ranks =
      cli::value_or_fail(RanksInProcess::make(scene, settings, parameters, count, FirstSpheres::in_order));
  const PictureTiles tiles(settings, count);
  Film film;
  film.resize(expected.width, expected.height, !expected.coverage.empty());
  std::vector<Drawn> drawn(static_cast<std::size_t>(count));
  std::atomic<int> next{0};
  std::exception_ptr failure;
  std::mutex mutex;
  std::vector<std::thread> threads;
  for (int i = 0; i < std::max(1, settings.threads); ++i)
    threads.emplace_back([&] {
      try {
        for (int rank = next++; rank < std::min<std::int64_t>(count, tiles.count()); rank = next++)
          drawn[static_cast<std::size_t>(rank)] = draw(*ranks, rank, settings, tiles, film);
      } catch (...) {
        const std::lock_guard lock(mutex);
        failure = std::current_exception();
      }
    });
  for (std::thread& thread : threads) thread.join();
  if (failure) std::rethrow_exception(failure);

  ExchangeCounts sum;
  std::vector<std::int64_t> spheres, sent, messages, bytes, rounds;
  std::vector<double> busy;
  for (int rank = 0; rank < count; ++rank) {
    const Drawn& one = drawn[static_cast<std::size_t>(rank)];
    const AnswersOfRank answers = ranks->answers(rank);
    sum.add(one.counts);
    spheres.push_back(ranks->scene(rank).size());
    sent.push_back(ranks->sent_bytes(rank));
    messages.push_back(one.counts.messages + 2 * answers.questions);
    bytes.push_back(one.counts.bytes + answers.bytes_in + answers.bytes_out);
    rounds.push_back(one.counts.rounds);
    busy.push_back(one.ms + answers.ms);
  }
  ordered_json json = ordered_json::object();
  json["ranks"] = count;
  json["same_bits"] = same_bits(film, expected);
  json["spheres"] = of_ranks(spheres);
  json["sent_bytes"] = of_ranks(sent);
  json["tiles"] = tiles.count();
  json["rays"] = sum.rays;
  json["asked"] = sum.asked;
  json["messages"] = sum.messages;
  json["bytes"] = sum.bytes;
  json["rounds"] = sum.rounds;
  json["messages_of_rank"] = of_ranks(messages);
  json["bytes_of_rank"] = of_ranks(bytes);
  json["rounds_of_rank"] = of_ranks(rounds);
  json["busy_ms_of_rank"] = of_ranks(busy);
  return json;
}

std::vector<int> counts_in(const std::string& words) {
  std::vector<int> counts;
  for (std::size_t begin = 0; begin <= words.size();) {
    const std::size_t end = std::min(words.find(',', begin), words.size());
    const int count = std::atoi(words.substr(begin, end - begin).c_str());
    if (count < 1 || count > 1 << 16) cli::fail_usage("no number of ranks: " + words, "give numbers as 1,16,1024");
    counts.push_back(count);
    begin = end + 1;
  }
  return counts;
}

void run(int argc, const char* const* argv) {
  if (argc < 3) cli::fail_usage("usage: bihive-ranks RANKS[,RANKS...] render INPUT [options of bihive render]", "");
  const std::vector<int> counts = counts_in(argv[1]);
  std::vector<const char*> words{argv[0]};
  words.insert(words.end(), argv + 2, argv + argc);
  const cli::Request request = cli::parse_command_line(static_cast<int>(words.size()), words.data());
  const auto* const asked = std::get_if<cli::RenderOptions>(&request);
  if (asked == nullptr) cli::fail_usage("bihive-ranks draws pictures", "write: bihive-ranks 16,1024 render INPUT");
  const cli::RenderOptions options = cli::with_film(*asked);
  cli::PreparedPicture prepared = cli::prepare_render(options);
  const Scene& scene = prepared.input.scene;
  RenderSettings& settings = prepared.settings;
  settings.threads = static_cast<int>(options.threads);
  if (const Status status = SpreadScene::refusal(scene, settings); !status) cli::fail(status.error());

  const Tracer tracer = cli::value_or_fail(Tracer::build(scene, Engine::wide, options.tree, settings.threads));
  const Timer timer;
  const Film expected = cli::value_or_fail(render(scene, tracer, settings)).film;
  ordered_json all = ordered_json::array();
  ordered_json alone = ordered_json::object();
  alone["ranks"] = 0;
  alone["spheres"] = scene.spheres.size();
  alone["render_ms"] = timer.elapsed_ms();
  alone["threads"] = settings.threads;
  all.push_back(alone);
  for (const int count : counts) all.push_back(measure(scene, settings, options.tree, count, expected));
  std::printf("%s\n", all.dump(1).c_str());
}

}  // namespace
}  // namespace bihive::bench

int main(int argc, char** argv) {
  try {
    bihive::bench::run(argc, argv);
  } catch (const bihive::cli::Failure& failure) {
    bihive::cli::say_error(failure.error.to_string());
    return failure.code;
  } catch (const std::exception& error) {
    bihive::cli::say_error(error.what());
    return 1;
  }
  return 0;
}
