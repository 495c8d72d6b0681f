#include "bihive/viewer/load_file.h"

#include <filesystem>
#include <utility>

#include "bihive/base/write_file.h"
#include "bihive/io/data_path.h"
#include "bihive/io/packed.h"
#include "bihive/scene/scene_file.h"

namespace bihive {
namespace {

// A scene file is read whole.
bool must_be_read_whole(const std::string& path) {
  const Result<std::string> head = read_head(path);
  return !head || looks_like_scene(*head);
}

}  // namespace

Result<LoadedFile> load_file(Viewer& viewer, const std::string& path, const ReadOptions& options,
                             std::int64_t whole_bytes) {
  const DataPath named = data_path(path);
  std::error_code unknown;
  const bool again = std::filesystem::is_regular_file(named.file, unknown);
  const auto size = again ? static_cast<std::int64_t>(std::filesystem::file_size(named.file, unknown)) : 0;
  const bool in_parts = !options.trajectory.empty() || !named.inside.empty() || size > whole_bytes;
  if (again && !unknown && in_parts && !must_be_read_whole(named.file)) {
    Result<std::shared_ptr<const Frames>> frames = open_frames(path, options);
    if (!frames) return frames.error();
    Result<SphereFile> first = (*frames)->read(numbered_frame(options.frame, (*frames)->count()));
    if (!first) return first.error();
    Result<SceneFacts> facts = viewer.load(std::move(*first), path);
    if (!facts) return facts.error();
    LoadedFile loaded{std::move(*facts), std::move(*frames)};
    if (loaded.frames->count() == 1) loaded.frames.reset();
    return loaded;
  }

  Result<std::string> bytes = read_file(path);
  if (!bytes) return bytes.error();
  Result<SceneFacts> facts = viewer.load(*bytes, path, options);
  if (!facts) return facts.error();
  bytes->clear();
  bytes->shrink_to_fit();
  LoadedFile loaded{std::move(*facts), nullptr};
  if (!again || loaded.facts.frames == 1 || !loaded.facts.is_file_of_spheres) return loaded;
  Result<std::shared_ptr<const Frames>> frames = open_frames(path, options);
  if (!frames) return frames.error();
  loaded.frames = std::move(*frames);
  return loaded;
}

}  // namespace bihive
