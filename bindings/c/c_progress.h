// Long calls, which the caller's progress function follows and may cancel.
#pragma once

#include <optional>
#include <string>

#include "bihive.h"
#include "bihive/base/watch.h"
#include "bihive/job/waiting.h"
#include "c_errors.h"

namespace bihive::c {

/// The progress function of a thread, as bihive_set_progress() set it.
struct Progress {
  bihive_progress report = nullptr;  ///< null: none
  void* context = nullptr;
};
Progress progress_of_thread() noexcept;

/// guarded() for long calls. Without a progress function body(nullptr) runs on this thread; with one body(&work) runs
/// on another, and the calls watched there end once the work is cancelled.
template <class Body>
int guarded_long(const Body& body) noexcept {
  const Progress progress = progress_of_thread();
  if (progress.report == nullptr) return guarded([&] { return body(static_cast<Work*>(nullptr)); });
  return guarded([&] {
    // The text of a failure belongs to the thread that failed.
    int state = kFailed;
    std::string text;
    wait_for_work(
        [&](Work& work) {
          state = guarded([&] { return body(&work); });
          if (state != kDone) text = last_error();
        },
        [&](double done) { return progress.report(done, progress.context) == 0; });
    if (state != kDone) failed(text.c_str());
    return state;
  });
}

/// guarded() for queries, which ask the progress function on this thread, while they work on it.
template <class Body>
int guarded_query(const Body& body) noexcept {
  return guarded([&] {
    const Progress progress = progress_of_thread();
    std::optional<Watch> watch;
    if (progress.report != nullptr)
      watch.emplace(ProgressCallback(), nullptr,
                    [progress](double done) { return progress.report(done, progress.context) == 0; });
    WatchedWork work(WatchedWork::InnerProgress::passed_on);
    try {
      return body();
    } catch (const Cancelled&) {
      return failed(cancelled_error());
    }
  });
}

/// While it lives, watched calls on this thread report their progress as this section of the whole work. Does nothing
/// without work.
class Section {
 public:
  Section(Work* work, double begin, double end) {
    if (work != nullptr) watch_.emplace(work->between(begin, end), &work->cancel);
  }

 private:
  std::optional<Watch> watch_;
};

}  // namespace bihive::c
