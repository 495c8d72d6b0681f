#include "bihive/base/watch.h"

#include <algorithm>
#include <cerrno>
#include <utility>

namespace bihive {
namespace {

constexpr std::chrono::milliseconds kBetweenReports(20);

// The share of a call that is done when one within it is.
constexpr double kMostOfInner = 0.99;

thread_local Watch* watch_of_thread = nullptr;
thread_local WatchedWork* work_of_thread = nullptr;

}  // namespace

Error cancelled_error() {
  return {"cancelled", "", 0, 0, "", ECANCELED};
}

bool is_cancelled(const Error& error) {
  return error.system_code == ECANCELED;
}

Watch::Watch(ProgressCallback progress, const CancelToken* cancel)
    : progress_(std::move(progress)), cancel_(cancel), outer_(std::exchange(watch_of_thread, this)) {}

Watch::~Watch() {
  watch_of_thread = outer_;
}

WatchedWork::WatchedWork(InnerProgress inner)
    : watch_(watch_of_thread), outer_(work_of_thread), inner_(inner), last_report_(std::chrono::steady_clock::now()) {
  if (watch_ != nullptr) work_of_thread = this;
}

WatchedWork::~WatchedWork() {
  work_of_thread = outer_;
}

WatchedWork* WatchedWork::current() {
  return work_of_thread;
}

void WatchedWork::report(double done) {
  if (watch_ == nullptr || !watch_->progress_) return;
  if (is_nested()) {
    if (outer_->inner_ == InnerProgress::passed_on) outer_->report(std::min(done, kMostOfInner));
    return;
  }
  // Another thread reports: then this report can be left out, unless it is the last.
  const bool is_last = done >= 1;
  std::unique_lock<std::mutex> lock(mutex_, std::defer_lock);
  if (is_last)
    lock.lock();
  else if (!lock.try_lock())
    return;
  const auto now = std::chrono::steady_clock::now();
  if (is_last ? reported_ == 0 || reported_ >= 1 : done <= reported_ || now - last_report_ < kBetweenReports) return;
  reported_ = std::min(done, 1.0);
  last_report_ = now;
  watch_->progress_(reported_);
}

void WatchedWork::stop_if_cancelled() const {
  if (cancelled()) throw Cancelled();
}

void stop_if_cancelled() {
  if (work_of_thread != nullptr) work_of_thread->stop_if_cancelled();
}

void stop_if_cancelled(double done) {
  if (work_of_thread == nullptr) return;
  work_of_thread->stop_if_cancelled();
  work_of_thread->report(done);
}

Unwatched::Unwatched()
    : watch_(std::exchange(watch_of_thread, nullptr)), work_(std::exchange(work_of_thread, nullptr)) {}

Unwatched::~Unwatched() {
  watch_of_thread = watch_;
  work_of_thread = work_;
}

}  // namespace bihive
