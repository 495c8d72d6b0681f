// A film encoded by ffmpeg, in segments, because an ffmpeg pipe cannot be resumed.
//
// FILE.part holds the segments, each named by its first picture and the first one after it. A segment gets this name
// when it is complete and ffmpeg has counted its pictures; a later run continues after the last one. Until then it has
// a unique name, because a killed run's ffmpeg may still write. In the end ffmpeg joins the segments without encoding
// them again. GIF and APNG, which cannot be joined, are made of segments without loss.

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <utility>

#include "bihive/base/setting_name.h"
#include "bihive/base/timer.h"
#include "bihive/job/failure.h"
#include "bihive/job/film/system_failure.h"
#include "film/codec_words.h"
#include "film/ffmpeg.h"
#include "film/film_folder.h"
#include "film/film_record.h"
#include "film/film_sink.h"

namespace bihive::cli {
namespace {

// Maximum age of a segment, which is what a killed run loses. It lasts at least a second, because each begins with a
// whole picture, which takes more space.
constexpr double kSegmentMs = 15e3;

constexpr const char* kUnfinished = "unfinished-";
constexpr const char* kJoined = "film.joined-";
constexpr const char* kList = "segments.txt";
constexpr const char* kMetadata = "film.metadata";
constexpr mode_t kForOwner = 0600;

struct Segment {
  std::int64_t begin = 0, end = 0;
};

std::string ending_of_film(const std::string& output) {
  return output.substr(output.rfind('.'));
}

// Segments of a GIF or APNG have no loss; the whole film is encoded in the end, a GIF with the palette of all pictures.
constexpr const char* kLosslessEnding = ".mkv";
constexpr const char* kPalette = "palette.png";

// The browser's own limit: shorter delays become longer ones.
constexpr std::int64_t kMostGifRate = 50;

class EncodedFilm final : public FilmSink {
 public:
  EncodedFilm(const FilmPlan& plan, const std::string& output, std::string ffmpeg, FilmFolder& film)
      : film_(film),
        animation_(is_animation(output) ? ending_of_film(output) : ""),
        ending_(animation_.empty() ? ending_of_film(output) : kLosslessEnding),
        ffmpeg_(std::move(ffmpeg)),
        record_(plan.record),
        pictures_(plan.positions()),
        shortest_((plan.asked.rate.pictures + plan.asked.rate.seconds - 1) / plan.asked.rate.seconds) {
    if (is_gif() && plan.asked.rate.pictures > kMostGifRate * plan.asked.rate.seconds)
      fail_usage(fmt::format("a GIF shows at most {} pictures per second", kMostGifRate),
                 "choose a lower " + setting_name("fps") + ", or let the output end in .apng");
    rate_ = fmt::format("{}/{}", plan.asked.rate.pictures, plan.asked.rate.seconds);
    input_ = {"-f",         "rawvideo",    "-pixel_format",
              "rgb24",      "-video_size", fmt::format("{}x{}", plan.fixed.width_px, plan.fixed.height_px),
              "-framerate", rate_,         "-i",
              "pipe:0",     "-an"};
    if (!animation_.empty())
      codec_ = {"-c:v", "ffv1", "-pix_fmt", "bgr0"};
    else
      codec_ = plan.asked.codec.empty() ? default_codec(ending_, plan.fixed.width_px, plan.fixed.height_px)
                                        : codec_words(plan.asked.codec);
    if (record_) record_->film = film_of_record(plan);
    if (film_.existing() != nullptr) find_segments(*film_.existing());
  }

  bool has(std::int64_t number) const override { return !segments_.empty() && number < segments_.back().end; }

  void add(const FilmPicture& picture) override {
    if (!run_) begin_segment();
    try {
      for (std::int64_t i = 0; i < picture.times; ++i)
        run_->write(picture.pixels.bytes.data(), picture.pixels.bytes.size());
    } catch (...) {
      run_.reset();
      throw;
    }
    in_segment_ += picture.times;
    if (record_) sha256_.insert(sha256_.end(), static_cast<std::size_t>(picture.times), sha256_of(picture.pixels));
    if (in_segment_ >= shortest_ && age_.elapsed_ms() >= kSegmentMs) end_segment();
  }

  void pause() override {
    if (run_) end_segment();
  }

  void finish() override {
    if (run_) end_segment();
    if (segments_.empty() || segments_.back().end != pictures_)
      fail({"the film lacks pictures", film_.folder().path(), 0, 0, "run the same again"});
    if (record_)
      for (const Segment& segment : segments_)
        for (std::string& digits : kept_sha256(film_.folder(), segment))
          record_->pictures_sha256.push_back(std::move(digits));
    if (!animation_.empty()) return film_.finish(animated());
    film_.finish(segments_.size() > 1 || record_ ? joined() : segment_name(segments_.front()));
  }

 private:
  std::string segment_name(const Segment& segment) const {
    return fmt::format("segment-{:08}-{:08}{}", segment.begin, segment.end, ending_);
  }

  // The SHA-256 of its pictures, in a file beside it.
  std::string sha256_name(const Segment& segment) const {
    return fmt::format("film.sha256-{:08}-{:08}", segment.begin, segment.end);
  }
  std::vector<std::string> kept_sha256(const OwnFolder& folder, const Segment& segment) const {
    constexpr std::size_t kDigits = 64;
    const std::string text = folder.read(sha256_name(segment)).value_or("");
    std::vector<std::string> all;
    for (std::size_t at = 0; at + kDigits < text.size(); at += kDigits + 1) all.push_back(text.substr(at, kDigits));
    return all;
  }

  // Keeps the consecutive segments from picture 0 on that have their pictures. Removes others, and what killed runs
  // left.
  void find_segments(const OwnFolder& folder) {
    std::vector<Segment> found;
    for (const std::string& name : folder.names()) {
      long long begin = 0, end = 0;
      if (std::sscanf(name.c_str(), "segment-%lld-%lld", &begin, &end) == 2 && begin < end)
        if (const Segment one{begin, end}; segment_name(one) == name) found.push_back(one);
      for (const char* const left : {kUnfinished, kJoined})
        if (name.rfind(left, 0) == 0) folder.remove(name);
    }
    std::sort(found.begin(), found.end(), [](const Segment& a, const Segment& b) {
      return a.begin != b.begin ? a.begin < b.begin : a.end > b.end;
    });
    for (const Segment& one : found) {
      const bool follows = one.begin == (segments_.empty() ? 0 : segments_.back().end) && one.end <= pictures_;
      if (follows && is_whole(folder, one))
        segments_.push_back(one);
      else
        folder.remove(segment_name(one));
    }
  }

  bool is_whole(const OwnFolder& folder, const Segment& segment) const {
    if (!folder.open_file(segment_name(segment), O_RDONLY)) return false;
    const std::int64_t pictures = segment.end - segment.begin;
    if (record_ && static_cast<std::int64_t>(kept_sha256(folder, segment).size()) != pictures) return false;
    try {
      check_pictures(ffmpeg_, folder, segment_name(segment), pictures);
      return true;
    } catch (const Failure&) {
      return false;
    }
  }

  void begin_segment() {
    const OwnFolder& folder = film_.folder();
    unfinished_ = kUnfinished + random_digits() + ending_;
    film_.note_file(unfinished_);
    std::vector<std::string> words = input_;
    words.insert(words.end(), codec_.begin(), codec_.end());
    words.push_back(FfmpegRun::url(folder, unfinished_));
    run_ = std::make_unique<FfmpegRun>(ffmpeg_, words, folder, FfmpegRun::Input::pictures);
    in_segment_ = 0;
    age_ = Timer();
  }

  void end_segment() {
    // The run is over, even if it fails.
    const std::unique_ptr<FfmpegRun> run = std::move(run_);
    run->finish();
    const OwnFolder& folder = film_.folder();
    const std::int64_t begin = segments_.empty() ? 0 : segments_.back().end;
    const Segment whole{begin, begin + in_segment_};
    check_and_flush(folder, unfinished_, in_segment_);
    if (record_) {
      std::string lines;
      for (const std::string& digits : sha256_) lines += digits + "\n";
      sha256_.clear();
      film_.note_file(sha256_name(whole));
      folder.remove(sha256_name(whole));
      folder.write_new(sha256_name(whole), lines, kForOwner);
    }
    folder.rename(unfinished_, segment_name(whole));
    segments_.push_back(whole);
    film_.keep();
  }

  // The file's bytes are on the disk before its name says that it is whole.
  void check_and_flush(const OwnFolder& folder, const std::string& name, std::int64_t pictures) const {
    const std::optional<Descriptor> file = folder.open_file(name, O_RDONLY);
    if (!file)
      fail_environment(
          {"ffmpeg reported success, but wrote no film", "", 0, 0, "check that " + ffmpeg_ + " is really ffmpeg"});
    check_pictures(ffmpeg_, folder, name, pictures);
    if (const int code = flush_to_disk(file->get()); code != 0)
      fail_of_system("writing failed", folder.path_of(name), code);
  }

  bool is_gif() const { return !animation_.empty() && (animation_[1] == 'g' || animation_[1] == 'G'); }

  // Paths in ffmpeg's list are relative to it.
  void write_list() const {
    const OwnFolder& folder = film_.folder();
    std::string list = "ffconcat version 1.0\n";
    for (const Segment& segment : segments_) list += "file " + segment_name(segment) + "\n";
    folder.remove(kList);
    folder.write_new(kList, list, kForOwner);
  }

  // A GIF or an APNG of all segments.
  std::string animated() const {
    const OwnFolder& folder = film_.folder();
    write_list();
    const std::vector<std::string> input{"-f", "concat", "-safe", "0",
                                         "-r", rate_,    "-i",    FfmpegRun::url(folder, kList)};
    const auto run = [&](const std::vector<std::string>& more, const std::string& name) {
      std::vector<std::string> words = input;
      words.insert(words.end(), more.begin(), more.end());
      words.push_back(FfmpegRun::url(folder, name));
      FfmpegRun(ffmpeg_, words, folder, FfmpegRun::Input::none).finish();
    };
    const std::string whole = kJoined + random_digits() + animation_;
    if (is_gif()) {
      folder.remove(kPalette);
      run({"-vf", "palettegen", "-frames:v", "1", "-update", "1", "-f", "image2"}, kPalette);
      run({"-i", FfmpegRun::url(folder, kPalette), "-lavfi", "paletteuse=diff_mode=rectangle", "-loop", "0", "-f",
           "gif"},
          whole);
      folder.remove(kPalette);
    } else {
      run({"-c:v", "apng", "-pix_fmt", "rgb24", "-plays", "0", "-f", "apng"}, whole);
    }
    if (record_) add_record_to_animation(folder, whole, is_gif(), to_text(*record_));
    check_and_flush(folder, whole, pictures_);
    return whole;
  }

  std::string joined() const {
    const OwnFolder& folder = film_.folder();
    write_list();
    std::string whole = kJoined + random_digits() + ending_;
    std::vector<std::string> words{"-f", "concat", "-safe", "0", "-i", FfmpegRun::url(folder, kList)};
    if (record_) {
      folder.remove(kMetadata);
      folder.write_new(kMetadata, ffmpeg_metadata(to_text(*record_)), kForOwner);
      for (const std::string& word :
           {std::string("-f"), std::string("ffmetadata"), std::string("-i"), FfmpegRun::url(folder, kMetadata),
            std::string("-map"), std::string("0"), std::string("-map_metadata"), std::string("1")})
        words.push_back(word);
    }
    words.insert(words.end(), {"-c", "copy", FfmpegRun::url(folder, whole)});
    FfmpegRun(ffmpeg_, words, folder, FfmpegRun::Input::none).finish();
    if (record_) folder.remove(kMetadata);
    check_and_flush(folder, whole, pictures_);
    return whole;
  }

  FilmFolder& film_;
  std::string animation_;  // ".gif" or ".apng"; empty: another film
  std::string ending_, ffmpeg_, rate_;
  std::optional<PictureRecord> record_;
  std::vector<std::string> sha256_;  // one per picture of the current segment
  std::int64_t pictures_, shortest_;
  std::vector<std::string> input_, codec_;
  std::vector<Segment> segments_;
  std::unique_ptr<FfmpegRun> run_;
  std::string unfinished_;
  std::int64_t in_segment_ = 0;
  Timer age_;
};

}  // namespace

std::unique_ptr<FilmSink> open_encoded(const FilmPlan& plan, const std::string& output, const std::string& ffmpeg,
                                       FilmFolder& film) {
  return std::make_unique<EncodedFilm>(plan, output, ffmpeg, film);
}

}  // namespace bihive::cli
