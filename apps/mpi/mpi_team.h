// The ranks of an MPI program as a team. Only this folder knows MPI.
#pragma once

#include <mpi.h>

#include <deque>
#include <mutex>
#include <vector>

#include "support/failure.h"
#include "support/team.h"

namespace bihive::mpi {

/// All ranks of MPI_COMM_WORLD make one at the same time, after MPI_Init_thread with MPI_THREAD_SERIALIZED or more, and
/// destroy it before MPI_Finalize.
class MpiTeam final : public cli::Team {
 public:
  MpiTeam();
  ~MpiTeam() override;
  MpiTeam(const MpiTeam&) = delete;
  MpiTeam& operator=(const MpiTeam&) = delete;

  int rank() const override { return rank_; }
  int size() const override { return size_; }
  /// Ranks on this machine.
  int size_on_machine() const { return size_on_machine_; }

  void agree(const std::vector<cli::Fingerprint>& seen) override;
  std::int64_t next_number() override;
  void stop_counting() override;
  void give(std::int64_t number, const Film& film) override;
  void end_giving(const RenderCounts& rays, bool failed) override;
  void receive() override;
  std::optional<cli::GivenRows> take(bool wait) override;
  bool somebody_failed() const override { return somebody_failed_; }
  RenderCounts rays_of_others() const override { return rays_of_others_; }

  /// All ranks come here at their end, unless a rank that failed made them leave agree(). Returns 0, or the code of the
  /// lowest rank that failed.
  int end_with(int code);
  /// Then: whether this rank is the one to say why.
  bool speaks() const { return speaks_; }

 private:
  int share(int code);
  bool receive_one(bool wait);

  int rank_ = 0, size_ = 1, size_on_machine_ = 1;
  std::mutex mutex_;  // MPI takes one thread at a time
  MPI_Win window_ = MPI_WIN_NULL;
  std::int64_t* counter_ = nullptr;

  // On their way from this rank: the bytes must stay.
  struct Sending {
    std::vector<char> bytes;
    MPI_Request request = MPI_REQUEST_NULL;
  };
  Sending sending_[2];
  int next_sending_ = 0;

  std::deque<cli::GivenRows> received_;
  int ended_ = 0;
  bool somebody_failed_ = false;
  int code_ = 0;  // of all
  bool speaks_ = false;
  RenderCounts rays_of_others_;
};

}  // namespace bihive::mpi
