#include "film/make_film.h"

#include <fmt/format.h>

#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include "bihive/base/setting_name.h"
#include "bihive/base/timer.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "bihive/job/prepare_picture.h"
#include "bihive/render/finished_pixels.h"
#include "bihive/render/frame_picture.h"
#include "commands/draw_on_ranks.h"
#include "commands/draw_picture.h"
#include "film/picture_queue.h"
#include "support/interrupt.h"
#include "support/say_tuned.h"
#include "support/thread_reserve.h"

namespace bihive::cli {
namespace {

struct ReadPicture {
  RenderOptions options;
  std::int64_t number = 0, times = 1;
  Input input;
};

// The tracer refers to the scene, so this stays where it is.
struct BuiltPicture {
  RenderOptions options;
  std::int64_t number = 0, times = 1;
  Input input;
  RenderSettings settings;
  std::optional<Tracer> tracer;
};

// Collects the bands of a picture as pixels, as the file of `bihive render` does.
class PixelsInMemory final : public PictureFile {
 public:
  PixelsInMemory(const BuiltPicture& picture, PngPixels& pixels) : picture_(picture), pixels_(pixels) {}

  Status add(const Film& film, const Tile& part) override {
    RenderSettings settings = picture_.settings;
    settings.crop = part;
    PngPixels rows = finished_pixels(film, picture_.input.scene, settings, bits());
    if (pixels_.height == 0) {
      pixels_ = std::move(rows);
      return Done{};
    }
    pixels_.height += rows.height;
    pixels_.bytes.insert(pixels_.bytes.end(), rows.bytes.begin(), rows.bytes.end());
    return Done{};
  }
  Status finish() override { return Done{}; }
  double bytes_of_pixel() const override { return (picture_.settings.transparent ? 4 : 3) * (bits() / 8.0); }

 private:
  int bits() const { return static_cast<int>(picture_.options.bits.value_or(8)); }

  const BuiltPicture& picture_;
  PngPixels& pixels_;
};

// The steps of one film and the queues between them.
class FilmSteps {
 public:
  FilmSteps(const FrameSource& source, const FilmPlan& plan, const RenderOptions& options, const Style& style,
            const PictureNumbers& pictures, FilmSink* sink, PictureCommunicator* ranks)
      : source_(source),
        plan_(plan),
        options_(options),
        style_(style),
        pictures_(pictures),
        sink_(sink),
        ranks_(ranks) {}

  FilmTimes run() {
    std::vector<std::thread> threads;
    try {
      threads.emplace_back([this] { guarded([this] { read_all(); }); });
      threads.emplace_back([this] { guarded([this] { build_all(); }); });
      threads.emplace_back([this] {
        guarded([this] { write_all(); });
        drawn_.close();
      });
    } catch (const std::system_error&) {
      // The system has no more threads: the film cannot be made.
      stop(std::current_exception());
    }
    guarded([this] { trace_all(); });
    for (std::thread& thread : threads) thread.join();

    // The writer is done, so that this thread may use the sink.
    if (failure_ || CancellableSection::token().cancelled()) {
      guarded([this] {
        if (sink_ != nullptr) sink_->pause();
      });
      if (CancellableSection::token().cancelled()) throw Interrupted{};
      std::rethrow_exception(failure_);
    }
    return times_;
  }

 private:
  // Runs a step. The first failure ends all steps.
  template <class Step>
  void guarded(const Step& step) {
    try {
      step();
    } catch (...) {
      stop(std::current_exception());
    }
  }
  void stop(std::exception_ptr failure) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!failure_) failure_ = std::move(failure);
    }
    read_.close();
    built_.close();
    drawn_.end();  // finished pictures are still written
  }

  void read_all() {
    for (auto next = pictures_.begin(); next != pictures_.end();) {
      if (CancellableSection::token().cancelled()) break;
      const Timer timer;
      ReadPicture picture{options_, *next, 0, {}};
      for (const std::int64_t first = plan_.first_position(picture.number);
           next != pictures_.end() && plan_.first_position(*next) == first; ++next)
        ++picture.times;
      picture.options.picture_of_film = picture.number;
      picture.options.input.reading.set_frame(-1);
      take_film(picture.options, plan_);
      Style style = style_;
      fix_range(style, plan_.fixed.range_of_style);
      picture.input = source_.load(plan_.frame_of(plan_.picture_at(picture.number)), style);
      warn(picture.input.warnings);
      times_.read_ms += timer.elapsed_ms();
      if (!read_.push(std::move(picture))) break;
    }
    read_.end();
  }

  void build_all() {
    while (std::optional<ReadPicture> read = read_.pop()) {
      const Timer timer;
      auto picture = std::make_unique<BuiltPicture>();
      picture->options = std::move(read->options);
      picture->number = read->number;
      picture->times = read->times;
      picture->input = std::move(read->input);
      const RenderEngine engine = choose_engine(options_);
      picture->settings = prepare_picture(picture->options, engine, picture->input, nullptr, &source_);
      if (picture->settings.width_px != plan_.fixed.width_px || picture->settings.height_px != plan_.fixed.height_px)
        if (!picture->settings.crop)
          fail({"the pictures of the film differ in size", "", 0, 0, "give one by " + setting_name("size")});
      tell_of_spheres_outside(*picture);
      check_memory_of(engine, picture->input, picture->options, picture->settings);
      if (options_.tune && !tuned_) tuned_ = say_tuned(picture->input.scene, engine, picture->settings);
      picture->tracer = value_or_fail(Tracer::build(picture->input.scene, structure_of(engine),
                                                    tuned_.value_or(options_.tree), picture->settings.threads));
      times_.build_ms += timer.elapsed_ms();
      if (!built_.push(std::move(picture))) break;
    }
    built_.end();
  }

  // Once, of a camera that bihive has placed for the first frame.
  void tell_of_spheres_outside(const BuiltPicture& picture) {
    constexpr double kMostOutside = 0.05;  // of all spheres
    const bool user_places = options_.eye || options_.look_at || options_.fit || options_.zoom_to || options_.zoom ||
                             (picture.input.has_camera && !options_.view_from && !options_.view_of);
    if (told_of_spheres_outside_ || user_places || plan_.asked.path.moves() || !plan_.asked.follow.empty() ||
        picture.settings.view == View::tree)
      return;
    const Scene& scene = picture.input.scene;
    const std::int64_t outside = spheres_outside(scene.spheres, scene.camera, picture.settings);
    if (!(static_cast<double>(outside) > kMostOutside * static_cast<double>(scene.spheres.total_size()))) return;
    told_of_spheres_outside_ = true;
    warn(fmt::format("{} of {} spheres are outside of picture {}: {} all brings those of all frames into view",
                     grouped(outside), grouped(scene.spheres.total_size()), picture.number,
                     setting_name("fit_frames")));
  }

  void trace_all() {
    Progress progress("film");
    std::int64_t done = 0;
    while (const std::optional<std::unique_ptr<BuiltPicture>> next = built_.pop()) {
      const Timer timer;
      const BuiltPicture& picture = **next;
      FilmPicture drawn;
      drawn.number = picture.number;
      drawn.times = picture.times;
      const auto update = [&](double share) {
        progress.update((static_cast<double>(done) + share) / static_cast<double>(pictures_.size()));
      };
      const bool renews_limit = done == 0 && is_limited();
      if (renews_limit) renew_group_limit_for_threads(picture.settings.threads);
      draw(picture, drawn.pixels, update);
      // The threads have their buffers now.
      if (renews_limit) turn_group_limit_into_failing_allocations();
      if (sink_ != nullptr && plan_.asked.metadata) {
        const nlohmann::ordered_json described =
            settings_json(picture.options, picture.settings, picture.input.scene, {});
        for (auto& [name, text] : text_of(picture.options, picture.input.scene, described))
          drawn.text.emplace_back(name, latin1(text));
        if (plan_.record && film_kind(options_.output) == FilmKind::pictures)
          drawn.text.emplace_back(kLateKeyword,
                                  to_text(record_of(picture.options, plan_.record->files, sha256_of(drawn.pixels))));
      }
      times_.trace_ms += timer.elapsed_ms();
      ++times_.pictures;
      done += picture.times;
      if (sink_ != nullptr && !drawn_.push(std::move(drawn))) break;
    }
    drawn_.end();
  }

  // Whether allocations fail where a control group has no more memory: see main.cpp.
  bool is_limited() const { return communicator() == nullptr && film_kind(options_.output) != FilmKind::encoded; }

  // With ranks, the picture is complete when all have done their share.
  void draw(const BuiltPicture& picture, PngPixels& drawn, const ProgressCallback& update) {
    PixelsInMemory pixels(picture, drawn);
    const RenderEngine engine = choose_engine(options_);
    const bool is_shared = ranks_ != nullptr && !is_gpu(engine) && !is_drawn_whole(picture.settings);
    if (ranks_ != nullptr) ranks_->barrier();
    if (is_shared)
      draw_on_ranks(picture.input.scene, *picture.tracer, picture.settings, sink_ != nullptr ? &pixels : nullptr,
                    update, *ranks_);
    else if (sink_ != nullptr)
      draw_picture(picture.input.scene, *picture.tracer, engine, picture.settings, {}, pixels, update);
    if (ranks_ != nullptr) ranks_->barrier();
  }

  void write_all() {
    while (const std::optional<FilmPicture> picture = drawn_.pop()) {
      const Timer timer;
      sink_->add(*picture);
      times_.write_ms += timer.elapsed_ms();
    }
  }

  const FrameSource& source_;
  const FilmPlan& plan_;
  const RenderOptions& options_;
  const Style& style_;
  const PictureNumbers& pictures_;
  FilmSink* sink_;
  PictureCommunicator* ranks_;
  PictureQueue<ReadPicture> read_{1, CancellableSection::token()};
  PictureQueue<std::unique_ptr<BuiltPicture>> built_{1, CancellableSection::token()};
  PictureQueue<FilmPicture> drawn_{1, CancellableSection::token()};
  std::mutex mutex_;
  std::exception_ptr failure_;
  bool told_of_spheres_outside_ = false;  // the thread that builds
  std::optional<TreeParameters> tuned_;   // found for the first frame, by the same thread
  FilmTimes times_;                       // each thread adds to its own
};

}  // namespace

FilmTimes make_film(const FrameSource& source, const FilmPlan& plan, const RenderOptions& options, const Style& style,
                    const PictureNumbers& pictures, FilmSink* sink, PictureCommunicator* ranks) {
  return FilmSteps(source, plan, options, style, pictures, sink, ranks).run();
}

}  // namespace bihive::cli
