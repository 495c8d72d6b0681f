// Searches the limits of the tree that suit the shown spheres (job/tuned_tree.h), in a thread of its own.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <thread>

#include "bihive/base/cancel.h"
#include "bihive/base/result.h"
#include "bihive/job/tuned_tree.h"
#include "bihive/scene/scene.h"
#include "bihive/viewer/viewer_settings.h"

namespace bihive::window {

class TreeSearch {
 public:
  /// `on_change` is called in the search's thread, at its end and now and then before.
  TreeSearch(Scene scene, const ViewerSettings& settings, std::function<void()> on_change);
  /// Ends the search.
  ~TreeSearch();
  TreeSearch(const TreeSearch&) = delete;
  TreeSearch& operator=(const TreeSearch&) = delete;

  bool finished() const { return finished_; }
  double done() const { return done_; }  ///< share, 0 to 1
  /// Once it is finished. Error: memory is too small for a tree.
  const Result<TunedTree>& result() const { return *result_; }

 private:
  void run();

  Scene scene_;
  RenderSettings settings_;
  std::function<void()> on_change_;
  CancelToken cancel_;
  std::atomic<double> done_ = 0;
  std::atomic<bool> finished_ = false;
  std::optional<Result<TunedTree>> result_;
  std::thread thread_;  // the last member: it uses the others
};

}  // namespace bihive::window
