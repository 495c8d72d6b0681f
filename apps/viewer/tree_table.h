// The trees of the scene on show in numbers, side by side.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bihive/viewer/viewer.h"

namespace bihive::window {

class TreeTable {
 public:
  /// Asks the viewer again where its scene or the tree's parameters have changed; a large scene's trees only once
  /// nothing moves any more.
  void update(const Viewer& viewer, bool settled);
  /// Whether it shows what is on show.
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
  std::optional<std::int64_t> max_prims_, max_depth_;  // that were asked for
  bool current_ = false;
};

}  // namespace bihive::window
