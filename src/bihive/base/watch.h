// How a caller watches long work: reading files, building trees, rendering. It hears of the progress, and may cancel.
//
// bihive::CancelToken stop;  // another thread may call stop.cancel()
// const bihive::Watch watch([](double done) { std::printf("%.0f %%\n", 100 * done); }, &stop);
// const auto file = bihive::read_spheres("large.xyz", {});
// if (!file && bihive::is_cancelled(file.error())) return;
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>

#include "bihive/base/cancel.h"
#include "bihive/base/result.h"

namespace bihive {

/// Called now and then, from one thread at a time, with the finished share, 0 to 1. It must not throw.
using ProgressCallback = std::function<void(double done)>;

/// The error of a call that was cancelled. Its system_code is ECANCELED.
Error cancelled_error();
bool is_cancelled(const Error& error);

/// As long as it lives, calls on its thread are watched: read_spheres(), load_scene(), Frames, WideBuilder::build(),
/// Tracer::build(), render() and its relatives if they get neither a callback nor a token of their own, and the queries
/// that return a Status or a Result (wide/queries.h, wide/point_queries.h).
///
/// - The callback gets the finished share of each call, an estimate by bytes, spheres, pixels, rays or points that
/// starts again with
///   the next call and never falls within one. It runs on any thread that does the work, at most fifty times per second
///   and not after the call has returned; short calls may never call it, and those that succeed after they did end with
///   1. It must not throw, nor call what is watched.
/// - Once the token is set, a call ends soon with cancelled_error(). There is no answer then; files, sets, trees and
///   builders that existed before are as they were, and nothing is written.
///
/// `look`, for callers whose functions belong to one thread, as those of other languages do: called by this thread
/// alone, about twenty times per second while it works in a query, with the finished share. False cancels the query.
///
/// The latest Watch of a thread counts. Threads do not inherit it.
class Watch {
 public:
  explicit Watch(ProgressCallback progress, const CancelToken* cancel = nullptr,
                 std::function<bool(double done)> look = {});
  ~Watch();
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

 private:
  friend class WatchedWork;
  friend class Unwatched;

  ProgressCallback progress_;
  const CancelToken* cancel_;
  std::function<bool(double done)> look_;
  Watch* outer_;
};

/// For the library's own functions: one call that is watched, as long as it lives. Within another such call of the
/// thread it obeys the same token, and its progress is dropped, or passed on up to 0.99 if the other one says so.
class WatchedWork {
 public:
  enum class InnerProgress { dropped, passed_on };
  explicit WatchedWork(InnerProgress inner = InnerProgress::dropped);
  ~WatchedWork();
  WatchedWork(const WatchedWork&) = delete;
  WatchedWork& operator=(const WatchedWork&) = delete;

  /// The innermost of this thread; null: nobody watches.
  static WatchedWork* current();
  bool is_nested() const { return outer_ != nullptr; }
  bool is_watched() const { return watch_ != nullptr; }

  /// These are for any thread. cancelled() calls the look of the Watch if it is due.
  bool cancelled();
  void report(double done);
  const CancelToken* cancel() const { return watch_ != nullptr ? watch_->cancel_ : nullptr; }
  /// Throws Cancelled if the token is set.
  void stop_if_cancelled();

 private:
  Watch* watch_;  // null: nobody watches
  WatchedWork* outer_;
  InnerProgress inner_;
  std::mutex mutex_;
  double reported_ = 0;
  std::chrono::steady_clock::time_point last_report_;

  bool look_if_due();
  std::thread::id thread_;  // that of the Watch
  std::chrono::steady_clock::time_point last_look_;
  std::atomic<double> done_{0};
  std::atomic<bool> stopped_{false};  // by look
};

/// Thrown by stop_if_cancelled(), for the function that made the outermost WatchedWork: it returns cancelled_error().
struct Cancelled {};

/// If a WatchedWork of this thread is cancelled: throws Cancelled. So only a call that catches it may have one.
void stop_if_cancelled();
/// The same, and reports that this share of the thread's WatchedWork is done.
void stop_if_cancelled(double done);

/// parallel_for() (base/parallel.h) as a section of the thread's WatchedWork: its progress goes from `begin` to `end`
/// as calls of body(i) return, and no more calls begin once it is cancelled. In the body stop_chunk_if_cancelled() ends
/// the call, on whichever thread it runs. The body may throw Cancelled and std::bad_alloc, which are thrown here after
/// all calls have ended. So only a call that catches Cancelled may use it.
void watched_for(int threads, std::int64_t count, const std::function<void(std::int64_t)>& body, double begin = 0,
                 double end = 1);
/// Throws Cancelled if this thread runs a call of a watched_for() that is cancelled. Elsewhere it does nothing.
void stop_chunk_if_cancelled();

/// Suspends the thread's Watch as long as it lives. parallel_for() needs that: its bodies must not throw, as cancelled
/// calls do.
class Unwatched {
 public:
  Unwatched();
  ~Unwatched();
  Unwatched(const Unwatched&) = delete;
  Unwatched& operator=(const Unwatched&) = delete;

 private:
  Watch* watch_;
  WatchedWork* work_;
};

}  // namespace bihive
