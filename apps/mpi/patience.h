// Time limits for ranks that may never answer.
#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace bihive::mpi {

/// Seconds of silence after which a rank gives up the others; 0: it waits forever. From BIHIVE_MPI_PATIENCE, else 30.
/// Nothing: the variable is malformed.
std::optional<int> patience_from_environment();
/// The end of an error message about a time limit.
inline constexpr const char* kMorePatience = "BIHIVE_MPI_PATIENCE=SECONDS waits longer, 0 forever";

/// Prints the error in one line, removes unfinished files, and ends this process. After MPI_Init, mpirun ends the
/// others.
[[noreturn]] void give_up(const std::string& error);

/// A thread that calls tick() once per second until it is told to end. Time is counted in ticks, so that a process that
/// was itself stopped for a while (Ctrl-Z, a suspended job) does not count that time.
class Ticks {
 public:
  /// True: a second has passed. False: end() was called.
  bool wait();
  void end();

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool ended_ = false;
};

/// Gives up if it exists for more than this many seconds (0: never): for collective calls such as MPI_Init and
/// MPI_Finalize. `missing`: what the other ranks have not done.
class WaitLimit {
 public:
  WaitLimit(int patience_s, const char* missing);
  ~WaitLimit();
  WaitLimit(const WaitLimit&) = delete;
  WaitLimit& operator=(const WaitLimit&) = delete;

 private:
  Ticks ticks_;
  std::thread thread_;
};

}  // namespace bihive::mpi
