// Statistics of both trees of the shown scene, side by side.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bihive/viewer/viewer.h"

namespace bihive::window {

class TreeTable {
 public:
  /// Updates if the viewer's scene or the tree's parameters have changed. For a large scene it waits until nothing
  /// moves.
  void update(const Viewer& viewer, bool settled);
  /// Whether it shows the statistics of the current scene.
  bool current() const { return current_; }
  /// A new scene.
  void forget() { current_ = false; }

  void draw() const;

 private:
  struct Row {
    std::string name, reference, wide;
  };
  void read(const std::string& json);

  std::vector<Row> rows_;
  std::string error_;
  std::optional<std::int64_t> max_prims_, max_depth_;  // of the last request
  bool current_ = false;
};

}  // namespace bihive::window
