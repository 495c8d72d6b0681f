#include "mpi_channel.h"

#include <chrono>
#include <exception>
#include <utility>

#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "mpi_messages.h"
#include "support/interrupt.h"

namespace bihive::mpi {
namespace {

// Interval at which the idle messenger checks for arrivals.
constexpr std::chrono::microseconds kPause{30};

// Interval at which a waiting thread checks for signals.
constexpr std::chrono::milliseconds kPatience{50};

// Tiles of a rank in flight, per drawing thread.
constexpr int kTilesOfThread = 4;

}  // namespace

MpiChannel::MpiChannel(MPI_Comm comm, std::function<Bytes(const Bytes&)> answer, int threads)
    : answer_(std::move(answer)), answering_(threads) {
  MPI_Comm_dup(comm, &comm_);
  MPI_Comm_rank(comm_, &rank_);
  MPI_Comm_size(comm_, &size_);
}

MpiChannel::~MpiChannel() {
  MPI_Comm_free(&comm_);
}

void MpiChannel::begin() {
  for (int i = 0; i < answering_; ++i) threads_.emplace_back([this] { answer_questions(); });
  messenger_ = std::thread([this] { run(); });
}

void MpiChannel::send(Message message) {
  {
    const std::lock_guard lock(mutex_);
    outgoing_.push_back(std::move(message));
  }
  left_something_.notify_one();
}

// Gives each message a number, and waits for the answers to all.
std::vector<Bytes> MpiChannel::send_and_wait(std::vector<Message> messages) {
  Waiter waiter{std::vector<Bytes>(messages.size()), messages.size(), {}};
  std::unique_lock lock(mutex_);
  const std::int64_t first = last_question_ + 1;
  for (std::size_t i = 0; i < messages.size(); ++i) {
    messages[i].number = ++last_question_;
    waiting_[last_question_] = {&waiter, i};
    outgoing_.push_back(std::move(messages[i]));
  }
  left_something_.notify_one();
  while (!waiter.arrived.wait_for(lock, kPatience, [&] { return waiter.missing == 0; })) {
    if (!cli::CancellableSection::token().cancelled()) continue;
    for (std::size_t i = 0; i < waiter.answers.size(); ++i) waiting_.erase(first + static_cast<std::int64_t>(i));
    throw ChannelClosed{};
  }
  return std::move(waiter.answers);
}

std::vector<Bytes> MpiChannel::ask(std::vector<Question> questions) {
  std::vector<Message> messages;
  messages.reserve(questions.size());
  for (Question& question : questions) messages.push_back({question.rank, kQuestion, 0, std::move(question.bytes)});
  return send_and_wait(std::move(messages));
}

std::int64_t MpiChannel::next_number() {
  if (rank_ == 0) {
    const std::lock_guard lock(mutex_);
    return counter_++;
  }
  const std::vector<Bytes> answers = send_and_wait({{0, kNumber, 0, {}}});
  return ByteReader(answers.front()).take<std::int64_t>();
}

void MpiChannel::stop_counting() {
  if (rank_ != 0) return send({0, kStopCounting, 0, {}});
  const std::lock_guard lock(mutex_);
  counter_ = std::int64_t{1} << 40;
}

void MpiChannel::give(std::int64_t number, const Film& film) {
  if (rank_ == 0) {
    const std::lock_guard lock(mutex_);
    tiles_.push_back({number, film});
    has_tiles_.notify_all();
    return;
  }
  Message message{0, kTile, 0, packed(number, film)};
  std::unique_lock lock(mutex_);
  may_give_.wait(lock, [this] { return tiles_on_way_ < kTilesOfThread * answering_; });
  ++tiles_on_way_;
  outgoing_.push_back(std::move(message));
  left_something_.notify_one();
}

void MpiChannel::end_giving(const cli::WorkOfRank& work, bool failed) {
  send({0, kEnd, 0, packed(EndOfRank{work, failed})});
}

void MpiChannel::end_own_giving() {
  const std::lock_guard lock(mutex_);
  own_ended_ = true;
  has_tiles_.notify_all();
}

std::optional<cli::GivenTile> MpiChannel::take(bool wait) {
  std::unique_lock lock(mutex_);
  if (wait) has_tiles_.wait(lock, [this] { return !tiles_.empty() || (own_ended_ && ended_ == size_ - 1); });
  if (tiles_.empty()) return std::nullopt;
  cli::GivenTile first = std::move(tiles_.front());
  tiles_.pop_front();
  return first;
}

bool MpiChannel::somebody_failed() const {
  const std::lock_guard lock(mutex_);
  return somebody_failed_;
}

cli::WorkOfRank MpiChannel::work_of_others() const {
  const std::lock_guard lock(mutex_);
  return work_of_others_;
}

// Rank 0 knows when all drawing threads have ended, on all ranks: then no more questions come.
void MpiChannel::end() {
  if (rank_ == 0) {
    // All at once: the messenger leaves after its own.
    const std::lock_guard lock(mutex_);
    for (int rank = 0; rank < size_; ++rank) outgoing_.push_back({rank, kAllEnded, 0, {}});
  }
  messenger_.join();
}

void MpiChannel::run() {
  bool is_open = true;
  while (is_open) {
    bool busy = send_all();
    while (receive_one()) busy = true;
    std::unique_lock lock(mutex_);
    is_open = !closing_;
    if (!busy && is_open) left_something_.wait_for(lock, kPause, [this] { return !outgoing_.empty(); });
  }
  leave();
}

// Returns whether there was something to do.
bool MpiChannel::send_all() {
  std::deque<Message> messages;
  {
    const std::lock_guard lock(mutex_);
    messages.swap(outgoing_);
  }
  for (Message& message : messages) {
    if (message.rank == rank_) {
      take_message(std::move(message));
      continue;
    }
    Sending& sending = sending_.emplace_back();
    sending.is_tile = message.tag == kTile;
    ByteWriter(message.bytes).put(message.number);
    sending.bytes = std::move(message.bytes);
    MPI_Isend(sending.bytes.data(), static_cast<int>(sending.bytes.size()), MPI_BYTE, message.rank, message.tag, comm_,
              &sending.request);
  }
  int arrived_tiles = 0;
  for (auto sending = sending_.begin(); sending != sending_.end();) {
    int arrived = 0;
    MPI_Test(&sending->request, &arrived, MPI_STATUS_IGNORE);
    if (arrived == 0) {
      ++sending;
      continue;
    }
    arrived_tiles += sending->is_tile ? 1 : 0;
    sending = sending_.erase(sending);
  }
  if (arrived_tiles > 0) {
    const std::lock_guard lock(mutex_);
    tiles_on_way_ -= arrived_tiles;
    may_give_.notify_all();
  }
  return !messages.empty();
}

// Returns whether there was one.
bool MpiChannel::receive_one() {
  int there = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, comm_, &there, &status);
  if (there == 0) return false;
  int count = 0;
  MPI_Get_count(&status, MPI_BYTE, &count);
  Message message{status.MPI_SOURCE, static_cast<Tag>(status.MPI_TAG), 0, Bytes(static_cast<std::size_t>(count))};
  MPI_Recv(message.bytes.data(), count, MPI_BYTE, message.rank, message.tag, comm_, MPI_STATUS_IGNORE);
  Bytes number(message.bytes.end() - static_cast<std::ptrdiff_t>(sizeof message.number), message.bytes.end());
  message.number = ByteReader(number).take<std::int64_t>();
  message.bytes.resize(message.bytes.size() - sizeof message.number);
  take_message(std::move(message));
  return true;
}

void MpiChannel::take_message(Message message) {
  const std::lock_guard lock(mutex_);
  switch (message.tag) {
    case kQuestion:
      questions_.push_back(std::move(message));
      has_question_.notify_one();
      return;
    case kAnswer: {
      const auto found = waiting_.find(message.number);
      if (found == waiting_.end()) return;  // the asking thread was stopped
      Waiter& waiter = *found->second.first;
      waiter.answers[found->second.second] = std::move(message.bytes);
      waiting_.erase(found);
      if (--waiter.missing == 0) waiter.arrived.notify_one();
      return;
    }
    case kNumber: {
      Bytes bytes;
      ByteWriter(bytes).put(counter_++);
      outgoing_.push_back({message.rank, kAnswer, message.number, std::move(bytes)});
      return;
    }
    case kStopCounting:
      counter_ = std::int64_t{1} << 40;
      return;
    case kTile:
      tiles_.push_back(unpacked_tile(message.bytes));
      has_tiles_.notify_all();
      return;
    case kEnd: {
      const EndOfRank end = unpacked_end(message.bytes);
      ++ended_;
      somebody_failed_ = somebody_failed_ || end.failed;
      work_of_others_.add(end.work);
      has_tiles_.notify_all();
      return;
    }
    case kAllEnded:
      closing_ = true;
      return;
  }
}

void MpiChannel::answer_questions() {
  for (;;) {
    std::unique_lock lock(mutex_);
    has_question_.wait(lock, [this] { return !questions_.empty() || no_more_questions_; });
    if (questions_.empty()) return;
    Message question = std::move(questions_.front());
    questions_.pop_front();
    lock.unlock();
    try {
      send({question.rank, kAnswer, question.number, answer_(question.bytes)});
    } catch (const std::exception& error) {
      // Another rank waits for the answer: MPI ends all ranks.
      say_error(error.what());
      MPI_Abort(MPI_COMM_WORLD, kBadInput);
    }
  }
}

// Answers the remaining questions, and receives until all ranks have sent everything.
void MpiChannel::leave() {
  {
    const std::lock_guard lock(mutex_);
    no_more_questions_ = true;
    has_question_.notify_all();
  }
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
  while (send_all() || !sending_.empty()) receive_one();
  MPI_Request all = MPI_REQUEST_NULL;
  MPI_Ibarrier(comm_, &all);
  for (int there = 0; there == 0; MPI_Test(&all, &there, MPI_STATUS_IGNORE)) receive_one();
}

}  // namespace bihive::mpi
