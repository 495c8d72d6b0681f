// The ranks of an MPI program as a team. Only this folder knows MPI.
#pragma once

#include <mpi.h>

#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "support/failure.h"
#include "support/team.h"

namespace bihive::mpi {

/// All ranks of MPI_COMM_WORLD make one at the same time, after MPI_Init_thread with MPI_THREAD_SERIALIZED or more, and
/// destroy it before MPI_Finalize.
class MpiTeam final : public cli::Team {
 public:
  /// `distributes`: the spheres are distributed over the ranks.
  explicit MpiTeam(bool distributes);
  ~MpiTeam() override;
  MpiTeam(const MpiTeam&) = delete;
  MpiTeam& operator=(const MpiTeam&) = delete;

  int rank() const override { return rank_; }
  int size() const override { return size_; }
  /// Ranks on this machine.
  int size_on_machine() const { return size_on_machine_; }

  bool distributes() const override { return distributes_; }
  std::unique_ptr<cli::Conversation> converse(std::function<Bytes(const Bytes&)> answer, int threads) override;
  std::vector<Bytes> gather(const Bytes& of_this_rank) override;
  Bytes from_first(Bytes of_first) override;
  void take_greatest(std::vector<double>& numbers) override;
  std::vector<Bytes> scatter(const std::vector<Bytes>& for_each_rank) override;

  void agree(const std::vector<cli::Fingerprint>& seen) override;
  std::int64_t next_number() override;
  void stop_counting() override;
  void give(std::int64_t number, const Film& film) override;
  void end_giving(const cli::WorkOfRank& work, bool failed) override;
  void receive() override;
  std::optional<cli::GivenRows> take(bool wait) override;
  bool somebody_failed() const override { return somebody_failed_; }
  cli::WorkOfRank work_of_others() const override { return work_of_others_; }

  /// All ranks come here at their end, unless a rank that failed made them leave agree(). Returns 0, or the code of the
  /// lowest rank that failed.
  int end_with(int code);
  /// Then: whether this rank is the one to say why.
  bool speaks() const { return speaks_; }

 private:
  int share(int code);
  void go_on_if_all_do();
  bool receive_one(bool wait);

  bool distributes_;
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
  cli::WorkOfRank work_of_others_;
};

}  // namespace bihive::mpi
