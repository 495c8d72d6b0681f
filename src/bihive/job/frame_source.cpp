#include "bihive/job/frame_source.h"

#include <algorithm>
#include <utility>

#include "bihive/job/failure.h"
#include "bihive/scene/load_scene.h"

namespace bihive {

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

std::vector<std::shared_ptr<const SphereSet>> FrameSource::before(std::int64_t frame, std::int64_t count) const {
  const std::int64_t first = std::max<std::int64_t>(frame - count, 0);
  const std::lock_guard<std::mutex> lock(kept_->mutex);
  auto& spheres = kept_->spheres;
  spheres.erase(spheres.begin(), spheres.lower_bound(first));
  spheres.erase(spheres.lower_bound(frame), spheres.end());
  std::vector<std::shared_ptr<const SphereSet>> found;
  for (std::int64_t k = first; k < frame; ++k) {
    std::shared_ptr<const SphereSet>& one = spheres[k];
    // Documents count from the end: 0 would be the frame that they name.
    if (one == nullptr)
      one = std::make_shared<const SphereSet>(load(frames_ != nullptr ? k : k - count_, Style()).scene.spheres);
    found.push_back(one);
  }
  return found;
}

}  // namespace bihive
