// Long work without Python's lock, which Ctrl-C stops.
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <exception>
#include <functional>
#include <thread>

#include "bihive/base/cancel.h"
#include "bihive/job/waiting.h"

namespace bihive::python {

/// Does the work on a thread of its own. The calling thread waits, and several times per second it checks for signals
/// and calls `progress` (None, or a function of the finished share), in the end with 1. An exception of either cancels
/// the work, and is thrown after its end.
void wait_for(const std::function<void(Work&)>& work, const pybind11::object& progress);

/// For work in short pieces on several threads, the calling one among them: it checks for signals between two pieces.
/// The caller must have released Python's lock.
class SignalWatch {
 public:
  /// Whether the work shall end. Only the constructor's thread handles signals; other threads just read the flag.
  bool cancelled();
  /// Throws what the signal's handler threw. Python's lock must be held.
  void rethrow() const;

 private:
  CancelToken cancel_;
  std::thread::id caller_ = std::this_thread::get_id();
  std::chrono::steady_clock::time_point last_look_ = std::chrono::steady_clock::now();
  std::exception_ptr thrown_;
};

}  // namespace bihive::python
