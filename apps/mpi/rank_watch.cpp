#include "rank_watch.h"

#include <unistd.h>

#include <chrono>
#include <string>

#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "support/interrupt.h"

namespace bihive::mpi {
namespace {

// All other messages have communicators of their own.
constexpr int kBeatTag = 1;
constexpr char kHere = 1, kLeaves = 2;

constexpr std::chrono::milliseconds kPauseAtTheEnd{2};
constexpr int kPausesPerSecond = 500;

}  // namespace

RankWatch::RankWatch(int patience_s) : patience_s_(patience_s) {
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
  if (patience_s_ > 0 && size_ > 1) thread_ = std::thread([this] { run(); });
}

RankWatch::~RankWatch() {
  if (!thread_.joinable()) return;
  ticks_.end();
  thread_.join();
}

void RankWatch::run() {
  expect();
  do {
    beat(kHere);
    listen();
    if (silence_s_ > patience_s_) end_all();
    ++silence_s_;
  } while (ticks_.wait());
  take_leave();
}

// No second beat is sent while the next rank has not taken the first.
void RankWatch::beat(char sign) {
  int arrived = 0;
  MPI_Test(&sending_, &arrived, MPI_STATUS_IGNORE);
  if (arrived == 0) return;
  sent_ = sign;
  MPI_Isend(&sent_, 1, MPI_CHAR, (rank_ + 1) % size_, kBeatTag, MPI_COMM_WORLD, &sending_);
}

void RankWatch::expect() {
  MPI_Irecv(&heard_, 1, MPI_CHAR, (rank_ + size_ - 1) % size_, kBeatTag, MPI_COMM_WORLD, &hearing_);
}

void RankWatch::listen() {
  int arrived = 1;
  while (!before_has_left_) {
    MPI_Test(&hearing_, &arrived, MPI_STATUS_IGNORE);
    if (arrived == 0) return;
    silence_s_ = 0;
    before_has_left_ = heard_ == kLeaves;
    if (!before_has_left_) expect();
  }
}

// Tell the next rank that no more beats come. The previous one may still work, as long as it is not silent.
void RankWatch::take_leave() {
  bool said = false;
  for (int pauses = 1;; ++pauses) {
    int arrived = 0;
    MPI_Test(&sending_, &arrived, MPI_STATUS_IGNORE);
    if (arrived != 0 && !said) {
      beat(kLeaves);
      said = true;
      continue;
    }
    listen();
    if (arrived != 0 && before_has_left_) return;
    if (pauses % kPausesPerSecond == 0 && ++silence_s_ > patience_s_) end_all();
    std::this_thread::sleep_for(kPauseAtTheEnd);
  }
}

void RankWatch::end_all() const {
  const int silent = (rank_ + size_ - 1) % size_;
  say_error("rank " + std::to_string(silent) + " has been silent for " + std::to_string(patience_s_) +
            " s: it was stopped, hangs, or is another program; " + kMorePatience);
  cli::remove_unfinished();
  MPI_Abort(MPI_COMM_WORLD, kEnvironment);
  _exit(kEnvironment);
}

}  // namespace bihive::mpi
