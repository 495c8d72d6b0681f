#include "tree_search.h"

#include <new>
#include <utility>

#include "bihive/base/watch.h"
#include "bihive/job/failure.h"

namespace bihive::window {

TreeSearch::TreeSearch(Scene scene, const ViewerSettings& settings, std::function<void()> on_change)
    : scene_(std::move(scene)),
      settings_(render_settings(settings, 1, 1, 1)),
      on_change_(std::move(on_change)),
      thread_([this] { run(); }) {}

TreeSearch::~TreeSearch() {
  cancel_.cancel();
  thread_.join();
}

void TreeSearch::run() {
  const Watch watch({}, &cancel_);
  const auto report = [this](double done) {
    done_ = done;
    on_change_();
  };
  try {
    result_ = tuned_tree(scene_, RenderEngine::automatic, settings_, report);
  } catch (const Failure& failure) {
    result_ = failure.error;
  } catch (const std::bad_alloc&) {
    result_ = Error{"there is not enough memory to search the tree's limits", "", 0, 0, ""};
  }
  finished_ = true;
  on_change_();
}

}  // namespace bihive::window
