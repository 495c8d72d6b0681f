// A rank that was stopped, hangs in the system or runs another program sends nothing, and the others would wait for it
// forever. So each rank sends a beat per second to the next one, in a ring, and listens to the previous one. Beats are
// sent by a separate thread, so that a rank that works for long still sends them.
#pragma once

#include <mpi.h>

#include <thread>

#include "patience.h"

namespace bihive::mpi {

class RankWatch {
 public:
  /// Collective: for all ranks of MPI_COMM_WORLD, after MPI_Init_thread with MPI_THREAD_MULTIPLE, before they exchange
  /// anything else. `patience_s`: a rank that has been silent for this time makes the next one end all by MPI_Abort; 0
  /// (or a single rank): nobody watches.
  explicit RankWatch(int patience_s);
  /// Collective; returns when the previous rank has called it.
  ~RankWatch();
  RankWatch(const RankWatch&) = delete;
  RankWatch& operator=(const RankWatch&) = delete;

 private:
  // For the thread.
  void run();
  void beat(char sign);
  void listen();
  void expect();
  void take_leave();
  [[noreturn]] void end_all() const;

  int patience_s_, rank_ = 0, size_ = 1;
  Ticks ticks_;
  char sent_ = 0, heard_ = 0;
  MPI_Request sending_ = MPI_REQUEST_NULL, hearing_ = MPI_REQUEST_NULL;
  int silence_s_ = 0;
  bool before_has_left_ = false;
  std::thread thread_;
};

}  // namespace bihive::mpi
