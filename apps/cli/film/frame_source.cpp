#include "film/frame_source.h"

#include <utility>

#include "bihive/base/write_file.h"
#include "bihive/job/failure.h"
#include "support/outputs.h"

namespace bihive::cli {

FrameSource FrameSource::open(const InputOptions& options, const Style& style, bool asked_for) {
  check_input_options(options);
  FrameSource source;
  source.options_ = options;
  source.asked_for_ = asked_for;
  if (is_generated(options.input)) {
    if (asked_for) fail_setting("style", " is for files, not for " + options.input);
    return source;
  }
  if (options.input != "demo" && !must_be_read_whole(options.input)) {
    ReadOptions reading = options.reading.options();
    reading.frame = 0;
    source.frames_ = value_or_fail(open_frames(options.input, reading, {.empty_frames = true}));
    source.count_ = source.frames_->count();
    return source;
  }
  if (options.input != "demo") {
    source.name_ = input_name(options.input);
    source.bytes_ = value_or_fail(unpack_if_packed(read_input(options.input), source.name_));
  }
  const Input first = source.load(0, style);
  source.count_ = first.frames;
  source.files_ = first.files;
  return source;
}

Input FrameSource::load(std::int64_t frame, const Style& style) const {
  if (std::optional<Input> generated = generated_input(options_)) return std::move(*generated);
  if (frames_) {
    Input input = scene_of_spheres(value_or_fail(frames_->read(frame)), options_.input, &style);
    add_trajectory(options_, input);
    return input;
  }
  ReadOptions reading = options_.reading.options();
  reading.frame = frame;
  const Style* const wanted = asked_for_ || !looks_like_scene(bytes_) ? &style : nullptr;
  return value_or_fail(options_.input == "demo" ? built_in_scene("demo", {}, reading, &style)
                                                : load_scene(bytes_, name_, reading, LooksOfFile::keep, wanted));
}

}  // namespace bihive::cli
