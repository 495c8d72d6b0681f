// Long calls, which the caller's progress function follows and may cancel.
#pragma once

#include <optional>
#include <string>

#include "bihive.h"
#include "bihive/base/watch.h"
#include "bihive/job/waiting.h"
#include "c_errors.h"

namespace bihive::c {

/// What bihive_set_progress() set for a thread.
struct Progress {
  bihive_progress report = nullptr;  ///< null: none
  void* context = nullptr;
};
Progress progress_of_thread() noexcept;

/// As guarded(), for long work: body(Work*) gets null if nobody follows, and else runs on another thread. What is
/// watched there ends once it is cancelled.
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

/// While it lives, the progress of watched calls on this thread is this section of the whole work. For nobody if there
/// is none.
class Section {
 public:
  Section(Work* work, double begin, double end) {
    if (work != nullptr) watch_.emplace(work->between(begin, end), &work->cancel);
  }

 private:
  std::optional<Watch> watch_;
};

}  // namespace bihive::c
