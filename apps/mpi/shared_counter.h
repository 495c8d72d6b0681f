// A counter shared by all ranks, by one-sided communication.
#pragma once

#include <mpi.h>

#include <cstdint>

namespace bihive::mpi {

/// It is stored on rank 0. Not for several threads of a rank at the same time.
class SharedCounter {
 public:
  /// Collective, also the destructor. Not shared if that is not requested, or impossible.
  SharedCounter(MPI_Comm comm, bool shared);
  ~SharedCounter();
  SharedCounter(const SharedCounter&) = delete;
  SharedCounter& operator=(const SharedCounter&) = delete;

  /// False also if this MPI has no one-sided communication between these machines, such as Debian's Open MPI (osc =
  /// ^ucx,pt2pt) between machines: then rank 0 alone may count, and the others ask it by messages.
  bool is_shared() const { return window_ != MPI_WIN_NULL; }

  /// Adds, and returns the previous number.
  std::int64_t add(std::int64_t number);
  /// For rank 0, while nobody adds.
  void set(std::int64_t number);

 private:
  MPI_Win window_ = MPI_WIN_NULL;
  std::int64_t unshared_ = 0;
};

}  // namespace bihive::mpi
