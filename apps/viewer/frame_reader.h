// Reads and prepares frames in a thread, so that the window never waits for a file or a tree.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/io/frames.h"
#include "bihive/viewer/frame_maker.h"

namespace bihive::window {

class FrameReader {
 public:
  /// `on_ready` is called in the reader's thread when a frame has come.
  FrameReader(std::shared_ptr<const Frames> frames, std::function<void()> on_ready);
  /// Waits for the frame being read.
  ~FrameReader();
  FrameReader(const FrameReader&) = delete;
  FrameReader& operator=(const FrameReader&) = delete;

  /// Requests this frame, and `ahead` frames after it. Drops results for other frames or another maker.
  void want(std::int64_t frame, std::optional<std::int64_t> ahead, std::shared_ptr<const FrameMaker> maker);
  /// The frame, once, if it is ready.
  std::optional<Result<std::shared_ptr<PreparedFrame>>> take(std::int64_t frame);

 private:
  struct Came {
    std::int64_t frame;
    Result<std::shared_ptr<PreparedFrame>> result;
  };

  void run();
  std::optional<std::int64_t> missing() const;

  std::shared_ptr<const Frames> frames_;
  std::function<void()> on_ready_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool ends_ = false;
  std::vector<std::int64_t> wanted_;  // not yet taken, the first one first
  std::shared_ptr<const FrameMaker> maker_;
  std::vector<Came> came_;
  std::thread thread_;  // the last member: it uses the others
};

}  // namespace bihive::window
