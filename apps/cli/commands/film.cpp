// bihive film: makes a film of a trajectory or a moving camera.

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "bihive/base/place_file.h"
#include "bihive/base/setting_name.h"
#include "bihive/base/version.h"
#include "bihive/base/write_file.h"
#include "bihive/job/choose_look.h"
#include "bihive/job/failure.h"
#include "bihive/job/frame_source.h"
#include "bihive/job/messages.h"
#include "bihive/job/prepare_picture.h"
#include "bihive/job/scene_request.h"
#include "bihive/render/memory.h"
#include "commands/commands.h"
#include "commands/draw_picture.h"
#include "film/codec_words.h"
#include "film/ffmpeg.h"
#include "film/film_folder.h"
#include "film/film_outputs.h"
#include "film/film_plan.h"
#include "film/film_sink.h"
#include "film/fix_film.h"
#include "film/make_film.h"
#include "film/picture_numbers.h"
#include "support/communicator.h"
#include "support/interrupt.h"
#include "support/peak_memory.h"
#include "support/request_files.h"
#include "words/given_options.h"

namespace bihive::cli {
namespace {

using nlohmann::ordered_json;

// Refuses options that contradict the kind of the film, before anything is read.
void check_film_options(const FilmOptions& options, FilmKind kind) {
  const RenderOptions& picture = options.picture;
  if (options.join && (!picture.input.input.empty() || options.shard || options.frames || options.pictures ||
                       !options.order.is_plain()))
    fail_setting("join", " takes the film's output alone: the shards know the rest", "bihive film --join -o run.mp4");
  if (!options.join && picture.input.input.empty()) fail_usage("bihive film needs an INPUT", "see bihive film --help");
  if (!options.codec.empty() && kind != FilmKind::encoded)
    fail_setting("codec", " is for films that ffmpeg encodes", "let the output end in .mp4, .mov, .mkv or .webm");
  if (!options.codec.empty() && is_animation(picture.output))
    fail_setting("codec", " is for .mp4, .mov, .mkv and .webm: GIF and APNG have one codec each", "leave it out");
  if (kind != FilmKind::pictures && picture.bits.value_or(8) != 8)
    fail_setting("bits", " 16 is for a sequence of pictures", "name the output run/%05d.png");
  if (kind != FilmKind::pictures && picture.background == kNoBackground)
    fail_usage("a film in one file has no transparent background", "name the output run/%05d.png");
  if (options.turntable_deg != 0 && !options.camera_keys.empty())
    fail_setting("turntable", " and " + setting_name("camera_keys") + " both move the camera", "leave one of them out");
  if (!options.turn_axis.empty() && options.turntable_deg == 0)
    fail_setting("turn_axis", " is for " + setting_name("turntable"), "add " + setting_name("turntable") + " 360");
  if (!options.follow.empty() && !options.align.empty())
    fail_setting("follow", " and " + setting_name("align") + " both keep spheres in place", "leave one of them out");
}

// Whether the pictures wait as files until all are drawn: those of a shard, and those that an encoder is given again on
// the way back.
bool pictures_wait(const FilmPlan& plan, const FilmOptions& options, FilmKind kind) {
  return kind != FilmKind::pictures && (options.shard || (kind == FilmKind::encoded && plan.asked.order.ping_pong));
}

std::unique_ptr<FilmSink> open_pictures(const FilmPlan& plan, const FilmOptions& options, bool store,
                                        const PictureNumbers& wanted, FilmFolder& folder) {
  return open_sequence(folder, {options.picture.output, store, options.shard.value_or(Shard{}), wanted,
                                plan.asked.order, plan.asked.pictures, options.picture.dots_per_inch});
}

std::unique_ptr<FilmSink> open_film(const FilmPlan& plan, const FilmOptions& options, FilmKind kind,
                                    const std::string& ffmpeg, FilmFolder& folder) {
  return kind == FilmKind::y4m ? open_y4m(plan, folder) : open_encoded(plan, options.picture.output, ffmpeg, folder);
}

// The first position of each picture of a shard, or of the film.
PictureNumbers first_positions(const FilmPlan& plan, const Shard& shard) {
  const std::int64_t held = plan.asked.order.hold_first, end = held + plan.asked.pictures;
  if (held == 0 || shard.index > 0) return PictureNumbers::every(shard.count, held + shard.index, end);
  PictureNumbers numbers(shard.count);
  numbers.add(0);
  for (std::int64_t k = held + shard.count; k < end; k += shard.count) numbers.add(k);
  return numbers;
}

// The positions that this run fills by pictures: each picture's first, or, of a film that is written in their order,
// all before the way back.
PictureNumbers wanted_positions(const FilmPlan& plan, const FilmOptions& options, FilmKind kind) {
  if (kind == FilmKind::pictures || pictures_wait(plan, options, kind))
    return first_positions(plan, options.shard.value_or(Shard{}));
  return PictureNumbers::every(1, 0, plan.asked.order.positions_forth(plan.asked.pictures));
}

struct FilmReport {
  FilmTimes times;
  std::int64_t kept = 0;
  double all_ms = 0;
};

void print_film_report(const FilmOptions& options, const FilmPlan& plan, const FilmReport& report) {
  const FilmTimes& times = report.times;
  const double rate = report.all_ms > 0 ? 1000.0 * static_cast<double>(times.pictures) / report.all_ms : 0;
  const std::string& output = options.picture.output;
  if (!options.picture.json) {
    const std::string kept = report.kept > 0 ? fmt::format(", {} kept from before", grouped(report.kept)) : "";
    const std::int64_t again = options.shard ? 0 : plan.positions() - plan.asked.pictures;
    const std::string repeated = again > 0 ? fmt::format(", {} shown again", grouped(again)) : "";
    const std::string of_shard =
        options.shard ? fmt::format(" (shard {}/{})", options.shard->index, options.shard->count) : "";
    print(
        fmt::format("{}{}: {} {} of {} x {}{}{}; {} at {:.3g} a second; read {}, build {}, trace {}, write {}; "
                    "peak memory {}\n",
                    escaped(output), of_shard, grouped(times.pictures), times.pictures == 1 ? "picture" : "pictures",
                    plan.fixed.width_px, plan.fixed.height_px, kept, repeated, readable_ms(report.all_ms), rate,
                    readable_ms(times.read_ms), readable_ms(times.build_ms), readable_ms(times.trace_ms),
                    readable_ms(times.write_ms), readable_bytes(peak_memory_bytes())));
    return;
  }
  ordered_json json = ordered_json::object();
  json["output"] = output;
  json["film"] = options.shard ? ordered_json() : ordered_json(plan_path(output));
  json["size"] = fmt::format("{}x{}", plan.fixed.width_px, plan.fixed.height_px);
  json["fps"] = static_cast<double>(plan.asked.rate.pictures) / static_cast<double>(plan.asked.rate.seconds);
  json["pictures"] = plan.positions();
  json["drawn"] = times.pictures;
  json["kept"] = report.kept;
  if (options.shard) json["shard"] = fmt::format("{}/{}", options.shard->index, options.shard->count);
  json["read_ms"] = times.read_ms;
  json["build_ms"] = times.build_ms;
  json["trace_ms"] = times.trace_ms;
  json["write_ms"] = times.write_ms;
  json["all_ms"] = report.all_ms;
  json["pictures_per_s"] = rate;
  json["peak_memory_bytes"] = peak_memory_bytes();
  print(as_text(json, 2) + "\n");
}

// Makes the missing pictures, and the film of all unless this is a shard. After a signal or a failure nothing is left
// if no picture is complete.
FilmTimes make_missing(const FrameSource& source, const FilmPlan& plan, const FilmOptions& options, const Style& style,
                       const PictureNumbers& wanted, const PictureNumbers& missing, FilmFolder& folder, FilmSink* sink,
                       PictureCommunicator* ranks) {
  const auto nothing_is_whole = [&] {
    if (sink == nullptr) return false;
    for (const std::int64_t number : wanted)
      if (sink->has(number)) return false;
    return true;
  };
  try {
    const FilmTimes times = make_film(source, plan, options.picture, style, missing, sink, ranks);
    if (!options.shard) sink->finish();
    return times;
  } catch (const Interrupted&) {
    if (nothing_is_whole()) folder.leave_nothing();
    CancellableSection::leave_if_cancelled();
    throw;
  } catch (...) {
    if (nothing_is_whole()) folder.leave_nothing();
    throw;
  }
}

// The options for ffmpeg come from a file here, unless the user gives them again.
void check_codec_of_shards(const FilmOptions& options, const FilmPlan& plan, const std::string& path) {
  const std::string& codec = plan.asked.codec;
  if (!options.codec.empty() && options.codec != codec)
    fail({"the shards were made for another codec: " + (codec.empty() ? "the default one" : codec), path, 0, 0,
          "leave " + setting_name("codec") + " out, or give that one"});
  if (!options.codec.empty()) return;
  if (const Status status = check_codec_of_file(codec); !status)
    fail({status.error().message, path, 0, 0, status.error().hint});
}

// The whole film of the pictures that wait. After a signal the next run continues. The caller has a CancellableSection.
void join_pictures(const FilmOptions& options, FilmKind kind, const std::string& ffmpeg, const FilmPlan& plan,
                   FilmFolder& folder) {
  try {
    const std::unique_ptr<FilmSink> sink = open_film(plan, options, kind, ffmpeg, folder);
    Progress progress("joining");
    for (std::int64_t k = 0; k < plan.positions(); ++k) {
      if (CancellableSection::token().cancelled()) {
        sink->pause();
        CancellableSection::leave_if_cancelled();
      }
      progress.update(static_cast<double>(k) / static_cast<double>(plan.positions()));
      if (sink->has(k)) continue;
      const std::string path = shard_picture_path(options.picture.output, plan.first_position(k));
      PngFile file = value_or_fail(read_png(path));
      if (file.image.width != plan.fixed.width_px || file.image.height != plan.fixed.height_px)
        fail({"has another size than the film", path, 0, 0, "remove it, and run its shard again"});
      FilmPicture picture;
      picture.number = k;
      picture.pixels = {file.image.width, file.image.height, 3, 8, std::move(file.image.rgb)};
      sink->add(picture);
    }
    sink->finish();
  } catch (const Interrupted&) {
    CancellableSection::leave_if_cancelled();
    throw;
  }
}

void join_shards(const FilmOptions& options, FilmKind kind, const std::string& ffmpeg) {
  const Timer timer;
  const std::string& output = options.picture.output;
  FilmFolder folder(output, kind);
  if (!folder.kept())
    fail(
        {"there are no shards of this film", output, 0, 0, "make them first: bihive film INPUT -o OUTPUT --shard i/N"});
  const FilmPlan plan = *folder.kept();
  check_codec_of_shards(options, plan, folder.plan_path());
  folder.begin(plan, /*alone=*/true);
  const PictureNumbers all = first_positions(plan, {});
  const std::unique_ptr<FilmSink> shards = open_pictures(plan, options, kind != FilmKind::pictures, all, folder);
  std::int64_t missing = 0, first = -1;
  for (const std::int64_t k : all)
    if (!shards->has(k) && missing++ == 0) first = k;
  if (missing > 0)
    fail({fmt::format("{} of {} pictures are missing, the first is number {}", missing, plan.asked.pictures, first),
          output, 0, 0, "run the shards that lack them again"});
  FilmReport report;
  report.times = options.of_shards;
  report.kept = plan.asked.pictures - report.times.pictures;
  if (kind == FilmKind::pictures) {
    shards->finish();
  } else {
    const CancellableSection section;
    join_pictures(options, kind, ffmpeg, plan, folder);
  }
  report.all_ms = timer.elapsed_ms() + options.ms_of_shards;
  print_film_report(options, plan, report);
}

// If there are more ranks than pictures, several ranks draw each picture together, and the first of them writes it.
// Null: alone.
std::unique_ptr<PictureCommunicator> ranks_of_picture(FilmOptions& options, std::int64_t pictures) {
  if (communicator() == nullptr || communicator()->size() <= pictures) return nullptr;
  const auto groups = static_cast<int>(pictures);
  const int number = communicator()->rank() % groups;
  options.shard = Shard{number, groups};
  return communicator()->split(number);
}

// A rank that fails tells the others of its picture, which leave silently.
template <class Run>
void run_on_ranks(PictureCommunicator* ranks, const Run& run) {
  if (ranks == nullptr) return run();
  try {
    run();
  } catch (const OtherRankFailed&) {
    throw OtherRankFailed{kSuccess};
  } catch (...) {
    ranks->end_with(kBadInput);
    throw;
  }
  if (ranks->end_with(kSuccess) != kSuccess) throw OtherRankFailed{kSuccess};
}

PictureNumbers of_rank_0(const PictureNumbers& numbers, PictureCommunicator& ranks) {
  Bytes bytes;
  ByteWriter(bytes).put_array(numbers.runs().data(), numbers.runs().size());
  bytes = ranks.broadcast(std::move(bytes));
  std::vector<PictureNumbers::Run> of_first(bytes.size() / sizeof(PictureNumbers::Run));
  ByteReader(bytes).take_array(of_first.data(), of_first.size());
  return PictureNumbers(numbers.step(), std::move(of_first));
}

// The rest, once the content of the film is known.
FilmTimes make_pictures(const FilmOptions& options, FilmKind kind, const std::string& ffmpeg, const Style& style,
                        const FrameSource& source, FilmPlan plan, FilmFolder& folder, PictureCommunicator* ranks,
                        const Timer& timer) {
  const CancellableSection section;
  if (!folder.kept()) {
    plan.fixed = fixed_by_film(source, plan, options, style);
    if (plan.asked.metadata) plan.record = record_of(options.picture, "");
  }
  CancellableSection::leave_if_cancelled();
  value_or_fail(check_picture_memory(plan.fixed.width_px, plan.fixed.height_px));
  const bool writes = ranks == nullptr || ranks->rank() == 0;
  const PictureNumbers wanted = wanted_positions(plan, options, kind);
  const bool wait = pictures_wait(plan, options, kind);
  std::unique_ptr<FilmSink> sink;
  if (writes) {
    folder.begin(plan, /*alone=*/!options.shard);
    try {
      sink = wait || kind == FilmKind::pictures ? open_pictures(plan, options, wait, wanted, folder)
                                                : open_film(plan, options, kind, ffmpeg, folder);
    } catch (const Interrupted&) {
      CancellableSection::leave_if_cancelled();
      throw;
    }
  }
  PictureNumbers missing(wanted.step());
  if (writes)
    for (const std::int64_t number : wanted)
      if (!sink->has(number)) missing.add(number);
  if (ranks != nullptr) missing = of_rank_0(missing, *ranks);

  // Make it.
  FilmReport report;
  for (const std::int64_t k : wanted)
    if (plan.first_position(k) == k && !missing.contains(k)) ++report.kept;
  report.times = make_missing(source, plan, options, style, wanted, missing, folder, sink.get(), ranks);
  if (wait && !options.shard) join_pictures(options, kind, ffmpeg, plan, folder);
  report.all_ms = timer.elapsed_ms();
  if (!options.silent) print_film_report(options, plan, report);
  // The rank that writes a picture counts it.
  if (!writes) report.times.pictures = 0;
  return report.times;
}

}  // namespace

FilmTimes run_film(const FilmOptions& asked) {
  const Timer timer;
  FilmOptions options = asked;
  // A film shows frames of its own choice.
  if (take_saved_request(options.picture, [](const std::string& id) { return id != "frame"; }))
    options.words = picture_words(options.picture.given);
  const FilmKind kind = film_kind(options.picture.output);
  check_film_options(options, kind);
  // Missing programs are named before any work.
  const std::string ffmpeg = kind == FilmKind::encoded && !options.shard ? find_ffmpeg() : "";
  check_film_outputs(options.picture.output, inputs_of(options));
  // A link stays, and the film is made beside its target.
  if (kind != FilmKind::pictures) {
    options.picture.output = value_or_fail(path_behind_links(options.picture.output));
    check_link_of_film(asked.picture.output, options.picture.output);
  }
  if (options.join) {
    join_shards(options, kind, ffmpeg);
    return {};
  }
  choose_engine(options.picture);
  warn_of_each_text_once();

  // Determine the content of the film, and whether an earlier run has begun it.
  const Style style = choose_style(options.picture.style);
  const FrameSource source = FrameSource::open(options.picture.input, style, !options.picture.style.name.empty());
  check_film_outputs(options.picture.output, source.files());
  FilmPlan plan;
  plan.asked = film_asked_for(options, source.count());
  FilmFolder folder(options.picture.output, kind);
  if (kind != FilmKind::pictures && !options.shard && !folder.kept())
    if (const std::optional<FilmPlan> made = finished_film(options.picture.output, plan.asked)) {
      folder.remove_rests();
      print_film_report(options, *made, {{}, made->asked.pictures, timer.elapsed_ms()});
      return {};
    }
  if (folder.kept()) {
    const std::string differs = difference(folder.kept()->asked, plan.asked);
    if (!differs.empty())
      fail({"holds pictures of another film: " + differs,
            kind == FilmKind::pictures ? plan_path(options.picture.output) : part_path(options.picture.output), 0, 0,
            std::string("remove it to ") + (kind == FilmKind::pictures ? "replace its pictures" : "begin anew") +
                ", or name another output"});
    plan = *folder.kept();
  }

  const std::unique_ptr<PictureCommunicator> ranks = ranks_of_picture(options, plan.asked.pictures);
  FilmTimes times;
  run_on_ranks(ranks.get(),
               [&] { times = make_pictures(options, kind, ffmpeg, style, source, plan, folder, ranks.get(), timer); });
  return times;
}

}  // namespace bihive::cli
