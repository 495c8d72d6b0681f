#include "shared_counter.h"

namespace bihive::mpi {

SharedCounter::SharedCounter(MPI_Comm comm, bool shared) {
  if (!shared) return;
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  std::int64_t* value = nullptr;
  // If MPI cannot do this, it is an error of the communicator, which must not end the program.
  MPI_Errhandler before = MPI_ERRHANDLER_NULL;
  MPI_Comm_get_errhandler(comm, &before);
  MPI_Comm_set_errhandler(comm, MPI_ERRORS_RETURN);
  const int result = MPI_Win_allocate(rank == 0 ? sizeof(std::int64_t) : 0, sizeof(std::int64_t), MPI_INFO_NULL, comm,
                                      &value, &window_);
  MPI_Comm_set_errhandler(comm, before);
  MPI_Errhandler_free(&before);
  const int mine = result == MPI_SUCCESS ? 1 : 0;
  int all = 0;
  MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_MIN, comm);
  if (all == 0) {
    window_ = MPI_WIN_NULL;
    return;
  }
  if (rank == 0) *value = 0;
  MPI_Barrier(comm);
  // Epochs last as long as the counter.
  MPI_Win_lock_all(0, window_);
}

SharedCounter::~SharedCounter() {
  if (!is_shared()) return;
  MPI_Win_unlock_all(window_);
  MPI_Win_free(&window_);
}

std::int64_t SharedCounter::add(std::int64_t number) {
  std::int64_t before = unshared_;
  if (!is_shared()) {
    unshared_ += number;
    return before;
  }
  MPI_Fetch_and_op(&number, &before, MPI_INT64_T, 0, 0, MPI_SUM, window_);
  MPI_Win_flush(0, window_);
  return before;
}

void SharedCounter::set(std::int64_t number) {
  add(number - add(0));
}

}  // namespace bihive::mpi
