// The communicator of an MPI program. Only this folder uses MPI.
#pragma once

#include <mpi.h>

#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "bihive/job/failure.h"
#include "shared_counter.h"
#include "support/communicator.h"

namespace bihive::mpi {

/// Collective: made by all ranks of the communicator, after MPI_Init_thread with MPI_THREAD_SERIALIZED or more, and
/// destroy it before MPI_Finalize.
class MpiCommunicator final : public cli::PictureCommunicator {
 public:
  enum class Counting { shared, by_messages };
  /// Copies the communicator. `distributes`: the spheres are distributed over the ranks. `counting`: numbers are sent
  /// by messages if no counter can be shared.
  MpiCommunicator(MPI_Comm comm, bool distributes, Counting counting);
  ~MpiCommunicator() override;
  MpiCommunicator(const MpiCommunicator&) = delete;
  MpiCommunicator& operator=(const MpiCommunicator&) = delete;

  int rank() const override { return rank_; }
  int size() const override { return size_; }
  /// Ranks on this machine.
  int size_on_machine() const { return size_on_machine_; }

  bool distributes() const override { return distributes_; }
  std::unique_ptr<cli::TileChannel> open_channel(std::function<Bytes(const Bytes&)> answer, int threads) override;
  std::vector<Bytes> all_gather(const Bytes& of_this_rank) override;
  Bytes broadcast(Bytes of_first) override;
  void all_reduce_max(std::vector<double>& numbers) override;
  std::vector<Bytes> all_to_all(const std::vector<Bytes>& for_each_rank) override;

  void barrier() override { go_on_if_all_do(); }
  void agree(const std::vector<cli::Fingerprint>& seen) override;
  std::unique_ptr<cli::PictureCommunicator> split(int colour) override;
  void begin_picture() override;
  std::int64_t next_number() override;
  void stop_counting() override;
  void give(std::int64_t number, const Film& film) override;
  void end_giving(const cli::WorkOfRank& work, bool failed) override;
  void move_on() override;
  std::optional<cli::GivenTile> take(bool wait) override;
  bool somebody_failed() const override { return somebody_failed_; }
  cli::WorkOfRank work_of_others() const override { return work_of_others_; }

  int end_with(int code) override;
  /// After end_with(): whether this rank reports the reason.
  bool speaks() const { return speaks_; }

 private:
  int share(int code);
  void go_on_if_all_do();
  bool receive_one(bool wait);
  void receive_all();
  void take_message(int source, int tag, const std::vector<char>& bytes);
  void ask_for_number();
  std::int64_t asked_number();

  MPI_Comm comm_ = MPI_COMM_NULL;
  bool distributes_;
  int rank_ = 0, size_ = 1, size_on_machine_ = 1;
  std::mutex mutex_;  // MPI takes one thread at a time
  std::unique_ptr<SharedCounter> counter_;

  // If the counter is not shared: an answer of rank 0 in flight.
  bool awaits_number_ = false;
  std::int64_t number_ = 0;
  MPI_Request number_request_ = MPI_REQUEST_NULL;

  // In flight from this rank: the bytes must stay.
  struct Sending {
    std::vector<char> bytes;
    MPI_Request request = MPI_REQUEST_NULL;
  };
  Sending sending_[2];
  int next_sending_ = 0;

  // In flight to this rank. A drawing rank makes progress on messages only now and then, so nobody waits for one.
  struct Receiving {
    int source, tag;
    std::vector<char> bytes;
    MPI_Request request = MPI_REQUEST_NULL;
  };
  std::deque<Receiving> receiving_;

  std::deque<cli::GivenTile> received_;
  int ended_ = 0;
  bool somebody_failed_ = false;
  int code_ = 0;  // of all
  bool speaks_ = false;
  cli::WorkOfRank work_of_others_;
};

}  // namespace bihive::mpi
