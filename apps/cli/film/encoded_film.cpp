// A film that ffmpeg encodes, in segments, because a pipe into ffmpeg cannot go on after an end.
//
// FILE.part holds the segments, each named by its first picture and the first one behind it. A segment gets this name
// when it is whole; a later run goes on behind the last one. In the end ffmpeg joins them without encoding them again.

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <utility>

#include "bihive/base/timer.h"
#include "bihive/base/write_file.h"
#include "film/ffmpeg.h"
#include "film/film_sink.h"
#include "film/system_failure.h"
#include "support/failure.h"

namespace bihive::cli {
namespace {

// A segment ends when it is so old: what a killed run loses. And it lasts a second at least, because each begins with a
// whole picture, which takes more room.
constexpr double kSegmentMs = 15e3;

struct Segment {
  std::int64_t begin = 0, end = 0;
};

std::string ending_of_film(const std::string& output) {
  return output.substr(output.rfind('.'));
}

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words(1);
  for (const char c : text)
    if (c == ' ')
      words.emplace_back();
    else
      words.back() += c;
  words.erase(std::remove(words.begin(), words.end(), std::string()), words.end());
  return words;
}

// Sides are even for H.264 with halved colours; the colours are those of screens.
std::vector<std::string> default_codec(const std::string& ending) {
  std::vector<std::string> words{"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv"};
  const std::vector<std::string> codec =
      ending == ".webm" ? words_of("-c:v libvpx-vp9 -crf 24 -b:v 0 -row-mt 1") : words_of("-c:v libx264 -crf 18");
  words.insert(words.end(), codec.begin(), codec.end());
  for (const char* word : {"-pix_fmt", "yuv420p", "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc",
                           "bt709", "-color_range", "tv"})
    words.emplace_back(word);
  return words;
}

class EncodedFilm final : public FilmSink {
 public:
  EncodedFilm(const FilmPlan& plan, std::string output, std::string ffmpeg)
      : output_(std::move(output)),
        folder_(part_path(output_)),
        ending_(ending_of_film(output_)),
        ffmpeg_(std::move(ffmpeg)),
        pictures_(plan.asked.pictures),
        shortest_((plan.asked.rate.pictures + plan.asked.rate.seconds - 1) / plan.asked.rate.seconds) {
    input_ = {"-f",
              "rawvideo",
              "-pixel_format",
              "rgb24",
              "-video_size",
              fmt::format("{}x{}", plan.fixed.width_px, plan.fixed.height_px),
              "-framerate",
              fmt::format("{}/{}", plan.asked.rate.pictures, plan.asked.rate.seconds),
              "-i",
              "pipe:0",
              "-an"};
    codec_ = plan.asked.codec.empty() ? default_codec(ending_) : words_of(plan.asked.codec);
    find_segments();
  }

  bool has(std::int64_t number) const override { return !segments_.empty() && number < segments_.back().end; }

  void add(const FilmPicture& picture) override {
    if (!run_) begin_segment();
    try {
      run_->write(picture.pixels.bytes.data(), picture.pixels.bytes.size());
    } catch (...) {
      run_.reset();
      throw;
    }
    ++in_segment_;
    if (in_segment_ >= shortest_ && age_.elapsed_ms() >= kSegmentMs) end_segment();
  }

  void pause() override {
    if (run_) end_segment();
  }

  void finish() override {
    if (run_) end_segment();
    if (segments_.empty() || segments_.back().end != pictures_)
      fail({"the film lacks pictures", folder_, 0, 0, "run the same again"});
    std::string whole = segment_path(segments_.front());
    if (segments_.size() > 1) whole = joined();
    sync(whole);
    if (std::rename(whole.c_str(), output_.c_str()) != 0) fail_of_system("cannot be written", output_, errno);
  }

 private:
  std::string segment_path(const Segment& segment) const { return folder_ + "/" + segment_name(segment); }
  std::string segment_name(const Segment& segment) const {
    return fmt::format("segment-{:08}-{:08}{}", segment.begin, segment.end, ending_);
  }
  std::string unfinished_path() const { return folder_ + "/unfinished" + ending_; }
  std::string log_path() const { return folder_ + "/ffmpeg.log"; }

  // Those that follow each other from picture 0 on. Others go away, and what a killed run left.
  void find_segments() {
    std::vector<Segment> found;
    DIR* const folder = opendir(folder_.c_str());
    if (folder == nullptr) fail_of_system("cannot be read", folder_, errno);
    while (const dirent* const entry = readdir(folder)) {
      long long begin = 0, end = 0;
      if (std::sscanf(entry->d_name, "segment-%lld-%lld", &begin, &end) == 2 && begin < end)
        if (const Segment one{begin, end}; segment_name(one) == entry->d_name) found.push_back(one);
    }
    closedir(folder);
    std::sort(found.begin(), found.end(), [](const Segment& a, const Segment& b) {
      return a.begin != b.begin ? a.begin < b.begin : a.end > b.end;
    });
    for (const Segment& one : found) {
      if (one.begin == (segments_.empty() ? 0 : segments_.back().end) && one.end <= pictures_)
        segments_.push_back(one);
      else
        unlink(segment_path(one).c_str());
    }
    unlink(unfinished_path().c_str());
  }

  void begin_segment() {
    std::vector<std::string> words = input_;
    words.insert(words.end(), codec_.begin(), codec_.end());
    words.push_back("file:" + unfinished_path());
    run_ = std::make_unique<FfmpegRun>(ffmpeg_, words, log_path());
    in_segment_ = 0;
    age_ = Timer();
  }

  void end_segment() {
    // It is no run any more, also if it fails.
    const std::unique_ptr<FfmpegRun> run = std::move(run_);
    run->finish();
    const std::int64_t begin = segments_.empty() ? 0 : segments_.back().end;
    const Segment whole{begin, begin + in_segment_};
    sync(unfinished_path());
    if (std::rename(unfinished_path().c_str(), segment_path(whole).c_str()) != 0)
      fail_of_system("ffmpeg has not written it", unfinished_path(), errno);
    segments_.push_back(whole);
  }

  // The file's bytes are on the disk before its name says that it is whole.
  void sync(const std::string& path) const {
    const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    const bool good = file >= 0 && fsync(file) == 0;
    const int code = errno;
    if (file >= 0) close(file);
    if (!good) fail_of_system("ffmpeg has not written it", path, code);
  }

  // Paths in ffmpeg's list are relative to it.
  std::string joined() const {
    std::string list = "ffconcat version 1.0\n";
    for (const Segment& segment : segments_) list += "file " + segment_name(segment) + "\n";
    const std::string list_path = folder_ + "/segments.txt", whole = folder_ + "/film" + ending_;
    value_or_fail(write_file(list_path, list));
    FfmpegRun(ffmpeg_, {"-f", "concat", "-safe", "0", "-i", "file:" + list_path, "-c", "copy", "file:" + whole},
              log_path())
        .finish();
    return whole;
  }

  std::string output_, folder_, ending_, ffmpeg_;
  std::int64_t pictures_, shortest_;
  std::vector<std::string> input_, codec_;
  std::vector<Segment> segments_;
  std::unique_ptr<FfmpegRun> run_;
  std::int64_t in_segment_ = 0;
  Timer age_;
};

}  // namespace

std::unique_ptr<FilmSink> open_encoded(const FilmPlan& plan, const std::string& output, const std::string& ffmpeg) {
  return std::make_unique<EncodedFilm>(plan, output, ffmpeg);
}

}  // namespace bihive::cli
