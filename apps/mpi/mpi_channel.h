// A channel between the ranks of MPI (support/communicator.h).
//
// One thread of each rank makes all MPI calls meanwhile: it sends what other threads have queued, and passes what
// arrives to those who wait for it. So computing threads never delay messages, and no rank waits for another one to
// listen.
#pragma once

#include <mpi.h>

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "support/communicator.h"

namespace bihive::mpi {

class MpiChannel final : public cli::TileChannel {
 public:
  /// Collective.
  MpiChannel(MPI_Comm comm, std::function<Bytes(const Bytes&)> answer, int threads);
  ~MpiChannel() override;
  MpiChannel(const MpiChannel&) = delete;
  MpiChannel& operator=(const MpiChannel&) = delete;

  void begin() override;
  void end_own_giving() override;
  void end() override;

  int rank() const override { return rank_; }
  int ranks() const override { return size_; }
  std::vector<Bytes> ask(std::vector<Question> questions) override;

  std::int64_t next_number() override;
  void stop_counting() override;
  void give(std::int64_t number, const Film& film) override;
  void end_giving(const cli::WorkOfRank& work, bool failed) override;
  std::optional<cli::GivenTile> take(bool wait) override;
  bool somebody_failed() const override;
  cli::WorkOfRank work_of_others() const override;

 private:
  enum Tag : int { kQuestion = 1, kAnswer, kNumber, kStopCounting, kTile, kEnd, kAllEnded };
  struct Message {
    int rank;
    Tag tag;
    std::int64_t number;  // of the question; 0: none
    Bytes bytes;
  };
  struct Sending {
    Bytes bytes;
    MPI_Request request = MPI_REQUEST_NULL;
    bool is_tile;
  };
  // A thread that waits for answers.
  struct Waiter {
    std::vector<Bytes> answers;
    std::size_t missing;
    std::condition_variable arrived;
  };

  void send(Message message);
  std::vector<Bytes> send_and_wait(std::vector<Message> messages);
  // For the MPI thread.
  void run();
  bool send_all();
  bool receive_one();
  void take_message(Message message);
  void leave();
  // For the answering threads.
  void answer_questions();

  int rank_ = 0, size_ = 1;
  MPI_Comm comm_ = MPI_COMM_NULL;
  std::function<Bytes(const Bytes&)> answer_;
  int answering_;
  std::vector<std::thread> threads_;
  std::thread messenger_;

  mutable std::mutex mutex_;
  std::condition_variable left_something_, may_give_, has_tiles_, has_question_;
  std::deque<Message> outgoing_, questions_;
  std::map<std::int64_t, std::pair<Waiter*, std::size_t>> waiting_;  // by the question's number
  std::int64_t last_question_ = 0;
  std::int64_t counter_ = 0;  // rank 0
  int tiles_on_way_ = 0;
  std::deque<cli::GivenTile> tiles_;
  int ended_ = 0;
  bool own_ended_ = false, somebody_failed_ = false, closing_ = false, no_more_questions_ = false;
  cli::WorkOfRank work_of_others_;
  std::list<Sending> sending_;  // of the messenger alone
};

}  // namespace bihive::mpi
