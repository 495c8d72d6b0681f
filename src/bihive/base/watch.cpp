#include "bihive/base/watch.h"

#include <algorithm>
#include <cerrno>
#include <new>
#include <utility>

#include "bihive/base/parallel.h"

namespace bihive {
namespace {

constexpr std::chrono::milliseconds kBetweenReports(20);
constexpr std::chrono::milliseconds kBetweenLooks(50);

// The share of a call that is done when one within it is.
constexpr double kMostOfInner = 0.99;

thread_local Watch* watch_of_thread = nullptr;
thread_local WatchedWork* work_of_thread = nullptr;
// That of the watched_for() whose body this thread runs.
thread_local WatchedWork* work_of_chunk = nullptr;

class WatchedChunk {
 public:
  explicit WatchedChunk(WatchedWork* work) : outer_(std::exchange(work_of_chunk, work)) {}
  ~WatchedChunk() { work_of_chunk = outer_; }
  WatchedChunk(const WatchedChunk&) = delete;
  WatchedChunk& operator=(const WatchedChunk&) = delete;

 private:
  WatchedWork* outer_;
};

}  // namespace

Error cancelled_error() {
  return {"cancelled", "", 0, 0, "", ECANCELED};
}

bool is_cancelled(const Error& error) {
  return error.system_code == ECANCELED;
}

Watch::Watch(ProgressCallback progress, const CancelToken* cancel, std::function<bool(double)> look)
    : progress_(std::move(progress)),
      cancel_(cancel),
      look_(std::move(look)),
      outer_(std::exchange(watch_of_thread, this)) {}

Watch::~Watch() {
  watch_of_thread = outer_;
}

WatchedWork::WatchedWork(InnerProgress inner) : watch_(watch_of_thread), outer_(work_of_thread), inner_(inner) {
  if (watch_ == nullptr) return;
  work_of_thread = this;
  last_report_ = last_look_ = std::chrono::steady_clock::now();
  thread_ = std::this_thread::get_id();
}

WatchedWork::~WatchedWork() {
  work_of_thread = outer_;
}

WatchedWork* WatchedWork::current() {
  return work_of_thread;
}

void WatchedWork::report(double done) {
  if (watch_ == nullptr) return;
  if (double known = done_.load(std::memory_order_relaxed); done > known)
    while (!done_.compare_exchange_weak(known, done, std::memory_order_relaxed) && done > known) {
    }
  if (!watch_->progress_) return;
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

bool WatchedWork::cancelled() {
  if (watch_ == nullptr) return false;
  if (watch_->cancel_ != nullptr && watch_->cancel_->cancelled()) return true;
  if (is_nested()) return outer_->cancelled();
  return stopped_.load(std::memory_order_relaxed) || look_if_due();
}

bool WatchedWork::look_if_due() {
  if (!watch_->look_ || std::this_thread::get_id() != thread_) return false;
  const auto now = std::chrono::steady_clock::now();
  if (now - last_look_ < kBetweenLooks) return false;
  last_look_ = now;
  if (watch_->look_(std::min(done_.load(std::memory_order_relaxed), 1.0))) return false;
  stopped_ = true;
  return true;
}

void WatchedWork::stop_if_cancelled() {
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

void watched_for(int threads, std::int64_t count, const std::function<void(std::int64_t)>& body, double begin,
                 double end) {
  WatchedWork* const work = WatchedWork::current();
  std::atomic<bool> stopped{false}, no_memory{false};
  std::atomic<std::int64_t> ended{0};
  parallel_for(threads, count, [&](std::int64_t i) {
    if (stopped || no_memory) return;
    const WatchedChunk chunk(work);
    try {
      stop_chunk_if_cancelled();
      body(i);
      if (work == nullptr) return;
      const std::int64_t done = ++ended;
      work->report(done == count ? end : begin + (end - begin) * double(done) / double(count));
    } catch (const Cancelled&) {
      stopped = true;
    } catch (const std::bad_alloc&) {
      no_memory = true;
    }
  });
  if (no_memory) throw std::bad_alloc();
  if (stopped) throw Cancelled();
}

void stop_chunk_if_cancelled() {
  if (work_of_chunk != nullptr) work_of_chunk->stop_if_cancelled();
}

Unwatched::Unwatched()
    : watch_(std::exchange(watch_of_thread, nullptr)), work_(std::exchange(work_of_thread, nullptr)) {}

Unwatched::~Unwatched() {
  watch_of_thread = watch_;
  work_of_thread = work_;
}

}  // namespace bihive
