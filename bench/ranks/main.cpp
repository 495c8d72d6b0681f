// Simulates a picture that many ranks draw, all of them in this process: messages, bytes, work, and the time that it
// would take. README.md says what is simulated.
//   bihive-ranks RANKS[,RANKS...] [--rate GBIT_PER_S] [--latency US] render INPUT [options of bihive render]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "bihive/base/timer.h"
#include "bihive/job/choose_look.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "bihive/job/picture_options.h"
#include "bihive/job/prepare_picture.h"
#include "bihive/render/picture_tiles.h"
#include "bihive/render/renderer.h"
#include "bihive/spread/ranks_in_process.h"

namespace bihive::bench {
namespace {

using nlohmann::ordered_json;

struct Network {
  double ms_per_byte, latency_ms;
};

// The clocks of a rank with one core, in milliseconds.
struct RankTimes {
  double core = 0;             // tracing rays, its own and those of others
  double network = 0;          // sending and receiving
  double threads[2] = {0, 0};  // when its threads are free, including the time that they wait for others
  std::int64_t messages = 0, bytes = 0, rounds = 0;

  // When a thread can begin with a tile.
  double ready(int thread) const { return std::max(threads[thread], core); }
  double end() const { return std::max({ready(0), ready(1), network}); }
};

// Other ranks answer at once, and all clocks advance by the time that it would have taken.
class SimulatedChannel final : public RankChannel {
 public:
  SimulatedChannel(int rank, RanksInProcess& all, const Network& network, std::vector<RankTimes>& times)
      : rank_(rank), all_(all), network_(network), times_(times) {}
  int rank() const override { return rank_; }
  int ranks() const override { return all_.size(); }

  std::vector<Bytes> ask(std::vector<Question> questions) override {
    const Timer all_answers;
    std::vector<Bytes> answers;
    RankTimes& own = of(rank_);
    double sum_ms = 0, slowest_ms = 0;
    for (const Question& question : questions) {
      const Timer timer;
      answers.push_back(all_.scene(question.rank).answer(question.bytes));
      const double answer_ms = timer.elapsed_ms();
      const std::size_t bytes = question.bytes.size() + answers.back().size();
      RankTimes& asked = of(question.rank);
      asked.core += answer_ms;
      const double sent_ms = static_cast<double>(bytes) * network_.ms_per_byte;
      for (RankTimes* const one : {&asked, &own}) {
        one->network += sent_ms;
        one->messages += 2;
        one->bytes += static_cast<std::int64_t>(bytes);
      }
      sum_ms += sent_ms;
      slowest_ms = std::max(slowest_ms, answer_ms);
    }
    ++own.rounds;
    waited_ms_ += network_.latency_ms + sum_ms + slowest_ms;
    real_ms_ += all_answers.elapsed_ms();
    return answers;
  }

  /// A tile begins.
  void begin(double at_ms) {
    begin_ms_ = at_ms;
    waited_ms_ = real_ms_ = 0;
    timer_ = Timer();
  }
  /// The work of this rank for the tile, and its time including waiting.
  double own_ms() const { return timer_.elapsed_ms() - real_ms_; }
  double now_ms() const { return begin_ms_ + own_ms() + waited_ms_; }

 private:
  RankTimes& of(int rank) { return times_[static_cast<std::size_t>(rank)]; }

  int rank_;
  RanksInProcess& all_;
  const Network& network_;
  std::vector<RankTimes>& times_;
  double begin_ms_ = 0, waited_ms_ = 0;
  double real_ms_ = 0;  // spent on answers here, which are the work of others
  Timer timer_;
};

// A rank that draws.
struct Drawer {
  std::unique_ptr<SimulatedChannel> channel;
  std::unique_ptr<SpreadScene::Artist> artist;
};

// The next tile goes to the thread that is free first, as with the counter of the ranks.
class SimulatedPicture {
 public:
  SimulatedPicture(RanksInProcess& ranks, const RenderSettings& settings, const Network& network)
      : ranks_(ranks),
        settings_(settings),
        network_(network),
        tiles_(settings, 2 * ranks.size()),
        times_(static_cast<std::size_t>(ranks.size())),
        drawers_(times_.size()) {
    settings_.threads = 1;
  }

  void draw(Film& film) {
    for (std::int64_t number = 0; number < tiles_.count(); ++number) {
      std::size_t rank = 0;
      int thread = 0;
      for (std::size_t i = 0; i < times_.size(); ++i)
        for (const int j : {0, 1})
          if (times_[i].ready(j) < times_[rank].ready(thread)) rank = i, thread = j;
      draw_tile(tiles_.pixels(number), rank, thread, film);
    }
  }

  ChannelCounts counts() const {
    ChannelCounts sum;
    for (const Drawer& drawer : drawers_)
      if (drawer.artist != nullptr) sum.add(drawer.artist->counts());
    return sum;
  }
  std::int64_t tiles() const { return tiles_.count(); }
  const std::vector<RankTimes>& times() const { return times_; }

 private:
  void draw_tile(const Tile& pixels, std::size_t rank, int thread, Film& film) {
    Drawer& drawer = drawers_[rank];
    if (drawer.artist == nullptr) {
      drawer.channel = std::make_unique<SimulatedChannel>(static_cast<int>(rank), ranks_, network_, times_);
      drawer.artist = ranks_.scene(static_cast<int>(rank)).artist(*drawer.channel);
    }
    drawer.artist->rest();
    RankTimes& times = times_[rank];
    drawer.channel->begin(times.ready(thread));
    RenderSettings of_tile = settings_;
    of_tile.crop = pixels;
    const Film drawn = value_or_fail(render(drawer.artist->scene(), drawer.artist->tracer(), of_tile)).film;
    times.core += drawer.channel->own_ms();
    times.threads[thread] = drawer.channel->now_ms();
    const Tile all = drawn_pixels(settings_);
    paste(drawn, pixels.x0 - all.x0, pixels.y0 - all.y0, film);
  }

  RanksInProcess& ranks_;
  RenderSettings settings_;
  Network network_;
  PictureTiles tiles_;
  std::vector<RankTimes> times_;
  std::vector<Drawer> drawers_;
};

// The mean and the largest of some numbers, one of each rank.
template <class Number>
ordered_json of_ranks(const std::vector<Number>& numbers) {
  const double sum = static_cast<double>(std::accumulate(numbers.begin(), numbers.end(), Number{}));
  return {{"mean", sum / static_cast<double>(numbers.size())},
          {"largest", *std::max_element(numbers.begin(), numbers.end())}};
}

bool same_bits(const Film& a, const Film& b) {
  return a.radiance.size() == b.radiance.size() &&
         std::memcmp(a.radiance.data(), b.radiance.data(), a.radiance.size() * sizeof(Vec3f)) == 0 &&
         a.coverage == b.coverage;
}

// of(rank) for each rank.
template <class Of>
auto each(int ranks, const Of& of) {
  std::vector<decltype(of(0))> numbers;
  numbers.reserve(static_cast<std::size_t>(ranks));
  for (int rank = 0; rank < ranks; ++rank) numbers.push_back(of(rank));
  return numbers;
}

ordered_json measure(const Scene& scene, const RenderSettings& settings, const TreeParameters& parameters, int count,
                     const Network& network, const Film& expected) {
  const std::unique_ptr<RanksInProcess> ranks =
      value_or_fail(RanksInProcess::make(scene, settings, parameters, count, FirstSpheres::in_order));
  SimulatedPicture picture(*ranks, settings, network);
  Film film;
  film.resize(expected.width, expected.height, !expected.coverage.empty());
  picture.draw(film);

  const std::vector<RankTimes>& times = picture.times();
  const auto of_times = [&](const auto& of) {
    return each(count, [&](int rank) { return of(times[std::size_t(rank)]); });
  };
  const std::vector<double> ends = of_times([](const RankTimes& one) { return one.end(); });
  const ChannelCounts counts = picture.counts();
  ordered_json json = ordered_json::object();
  json["ranks"] = count;
  json["same_bits"] = same_bits(film, expected);
  json["simulated_ms"] = *std::max_element(ends.begin(), ends.end());
  json["tiles"] = picture.tiles();
  json["rays"] = counts.rays;
  json["asked"] = counts.asked;
  json["messages"] = counts.messages;
  json["bytes"] = counts.bytes;
  json["rounds"] = counts.rounds;
  json["spheres_of_rank"] = of_ranks(each(count, [&](int rank) { return ranks->scene(rank).size(); }));
  json["sent_bytes_of_rank"] = of_ranks(each(count, [&](int rank) { return ranks->sent_bytes(rank); }));
  json["messages_of_rank"] = of_ranks(of_times([](const RankTimes& one) { return one.messages; }));
  json["bytes_of_rank"] = of_ranks(of_times([](const RankTimes& one) { return one.bytes; }));
  json["rounds_of_rank"] = of_ranks(of_times([](const RankTimes& one) { return one.rounds; }));
  json["core_ms_of_rank"] = of_ranks(of_times([](const RankTimes& one) { return one.core; }));
  return json;
}

std::vector<int> counts_in(const std::string& words) {
  std::vector<int> counts;
  for (std::size_t begin = 0; begin <= words.size();) {
    const std::size_t end = std::min(words.find(',', begin), words.size());
    const int count = std::atoi(words.substr(begin, end - begin).c_str());
    if (count < 1 || count > 1 << 16) fail_usage("no number of ranks: " + words, "give numbers as 1,16,1024");
    counts.push_back(count);
    begin = end + 1;
  }
  return counts;
}

double number_in(const std::string& word) {
  char* end = nullptr;
  const double number = std::strtod(word.c_str(), &end);
  if (word.empty() || *end != '\0' || !(number >= 0)) fail_usage("not a number: " + word, "see bench/README.md");
  return number;
}

constexpr const char* kUsage =
    "bihive-ranks RANKS[,RANKS...] [--rate GBIT_PER_S] [--latency US] render INPUT [options of bihive render]";

void run(int argc, const char* const* argv) {
  if (argc < 3) fail_usage("too few arguments", kUsage);
  const std::vector<int> counts = counts_in(argv[1]);
  double gbit_per_s = 10, latency_us = 50;
  int at = 2;
  for (; at + 1 < argc && std::string(argv[at]) != "render"; at += 2) {
    const std::string option = argv[at];
    if (option != "--rate" && option != "--latency") fail_usage("no option " + option, kUsage);
    (option == "--rate" ? gbit_per_s : latency_us) = number_in(argv[at + 1]);
  }
  if (gbit_per_s == 0) fail_usage("--rate 0: nothing would arrive", kUsage);
  const Network network{8e-6 / gbit_per_s, latency_us / 1000};
  if (at + 1 >= argc) fail_usage("bihive-ranks draws pictures", kUsage);
  PictureRequest request;
  request.input.input = argv[at + 1];
  take_words(request, {argv + at + 2, argv + argc});
  Style style = choose_style(request.style);
  Input input = load_input(request.input, LooksOfFile::keep, &style, !request.style.name.empty());
  RenderSettings settings = prepare_picture(request, choose_engine(request), input);
  const Scene& scene = input.scene;
  settings.threads = 1;
  if (const Status status = SpreadScene::refusal(scene, settings); !status) fail(status.error());

  // One process with all spheres.
  const Tracer tracer = value_or_fail(Tracer::build(scene, Engine::wide, request.tree));
  const Rendered expected = value_or_fail(render(scene, tracer, settings));
  ordered_json json = ordered_json::object();
  json["spheres"] = scene.spheres.size();
  json["render_ms"] = expected.render_ms;
  json["gbit_per_s"] = gbit_per_s;
  json["latency_us"] = latency_us;
  json["simulated"] = ordered_json::array();
  for (const int count : counts)
    json["simulated"].push_back(measure(scene, settings, request.tree, count, network, expected.film));
  std::printf("%s\n", json.dump(1).c_str());
}

}  // namespace
}  // namespace bihive::bench

int main(int argc, char** argv) {
  try {
    bihive::name_settings_as_options();
    bihive::bench::run(argc, argv);
  } catch (const bihive::Failure& failure) {
    bihive::say_error(failure.error.to_string());
    return failure.code;
  } catch (const std::exception& error) {
    bihive::say_error(error.what());
    return 1;
  }
  return 0;
}
