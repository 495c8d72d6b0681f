// A number that all ranks count together, by one-sided communication.
#pragma once

#include <mpi.h>

#include <cstdint>

namespace bihive::mpi {

/// It lies with rank 0. Not for several threads of a rank at the same time.
class SharedCounter {
 public:
  /// For all ranks at the same time, also the destructor. Not shared if it shall not be, or cannot.
  SharedCounter(MPI_Comm comm, bool shared);
  ~SharedCounter();
  SharedCounter(const SharedCounter&) = delete;
  SharedCounter& operator=(const SharedCounter&) = delete;

  /// False also where this MPI has no one-sided communication between these machines: then rank 0 alone may count, and
  /// the others ask it by messages. So is Open MPI as Debian sets it up (osc = ^ucx,pt2pt), from machine to machine.
  bool is_shared() const { return window_ != MPI_WIN_NULL; }

  /// Adds, and gives the number before.
  std::int64_t add(std::int64_t number);
  /// Rank 0, while nobody adds.
  void set(std::int64_t number);

 private:
  MPI_Win window_ = MPI_WIN_NULL;
  std::int64_t unshared_ = 0;
};

}  // namespace bihive::mpi
