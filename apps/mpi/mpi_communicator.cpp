#include "mpi_communicator.h"

#include <algorithm>
#include <climits>
#include <numeric>
#include <utility>

#include "mpi_channel.h"
#include "mpi_messages.h"

namespace bihive::mpi {
namespace {

enum Tag : int { kTile = 1, kEnd, kScattered, kAskNumber, kNumber };

// Maximum message length, because MPI counts bytes with 31 bits.
constexpr std::size_t kLongestMessage = std::size_t{1} << 29;

// Calls use(bytes, count) for each message that sends a piece of these bytes.
template <class Use>
void for_each_message(char* bytes, std::size_t count, const Use& use) {
  for (std::size_t first = 0; first < count; first += kLongestMessage)
    use(bytes + first, static_cast<int>(std::min(kLongestMessage, count - first)));
}

}  // namespace

MpiCommunicator::MpiCommunicator(MPI_Comm comm, bool distributes, Counting counting) : distributes_(distributes) {
  MPI_Comm_dup(comm, &comm_);
  MPI_Comm_rank(comm_, &rank_);
  MPI_Comm_size(comm_, &size_);
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(comm_, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &machine);
  MPI_Comm_size(machine, &size_on_machine_);
  MPI_Comm_free(&machine);
  counter_ = std::make_unique<SharedCounter>(comm_, counting == Counting::shared);
}

MpiCommunicator::~MpiCommunicator() {
  counter_.reset();
  MPI_Comm_free(&comm_);
}

std::unique_ptr<cli::PictureCommunicator> MpiCommunicator::split(int colour) {
  go_on_if_all_do();
  MPI_Comm part = MPI_COMM_NULL;
  MPI_Comm_split(comm_, colour, rank_, &part);
  // Open MPI 4.1.4 gives the windows of several such subsets on one machine the same file in shared memory.
  auto ranks = std::make_unique<MpiCommunicator>(part, distributes_, Counting::by_messages);
  MPI_Comm_free(&part);
  return ranks;
}

// The lowest rank that failed, and its code.
int MpiCommunicator::share(int code) {
  const std::lock_guard lock(mutex_);
  const int mine = code == 0 ? INT_MAX : rank_;
  int lowest = INT_MAX;
  MPI_Allreduce(&mine, &lowest, 1, MPI_INT, MPI_MIN, comm_);
  if (lowest == INT_MAX) return 0;
  MPI_Bcast(&code, 1, MPI_INT, lowest, comm_);
  code_ = code;
  speaks_ = lowest == rank_;
  return code;
}

int MpiCommunicator::end_with(int code) {
  // After a failure all ranks know already.
  return code_ != 0 ? code_ : share(code);
}

// A failed rank reports it instead of taking part in the collective call.
void MpiCommunicator::go_on_if_all_do() {
  if (const int code = share(0); code != 0) throw cli::OtherRankFailed{code};
}

void MpiCommunicator::agree(const std::vector<cli::Fingerprint>& seen) {
  go_on_if_all_do();
  if (seen.empty()) return;

  // Compare with rank 0.
  std::vector<std::uint64_t> wanted;
  wanted.reserve(seen.size());
  for (const cli::Fingerprint& one : seen) wanted.push_back(one.hash);
  {
    const std::lock_guard lock(mutex_);
    MPI_Bcast(wanted.data(), static_cast<int>(wanted.size()), MPI_UINT64_T, 0, comm_);
  }
  std::string differs;
  for (std::size_t i = 0; i < seen.size() && differs.empty(); ++i)
    if (seen[i].hash != wanted[i]) differs = seen[i].what;
  const int code = share(differs.empty() ? 0 : kBadInput);
  if (code == 0) return;
  if (differs.empty()) throw cli::OtherRankFailed{code};
  fail({differs + " of rank " + std::to_string(rank_) + " is not that of rank 0", "", 0, 0,
        "give all ranks the same program and the same arguments"});
}

void MpiCommunicator::begin_picture() {
  go_on_if_all_do();
  const std::lock_guard lock(mutex_);
  if (rank_ == 0) counter_->set(0);
  ended_ = 0;
  somebody_failed_ = false;
  work_of_others_ = {};
  MPI_Barrier(comm_);
}

std::int64_t MpiCommunicator::next_number() {
  const std::lock_guard lock(mutex_);
  return counter_->is_shared() || rank_ == 0 ? counter_->add(1) : asked_number();
}

// Rank 0 answers when it checks for messages, so ranks request a number while they work on the previous one.
void MpiCommunicator::ask_for_number() {
  MPI_Irecv(&number_, 1, MPI_INT64_T, 0, kNumber, comm_, &number_request_);
  MPI_Send(nullptr, 0, MPI_BYTE, 0, kAskNumber, comm_);
  awaits_number_ = true;
}

std::int64_t MpiCommunicator::asked_number() {
  if (!awaits_number_) ask_for_number();
  MPI_Wait(&number_request_, MPI_STATUS_IGNORE);
  awaits_number_ = false;
  const std::int64_t number = number_;
  ask_for_number();
  return number;
}

void MpiCommunicator::stop_counting() {
  const std::lock_guard lock(mutex_);
  counter_->add(std::int64_t{1} << 40);
}

void MpiCommunicator::give(std::int64_t number, const Film& film) {
  std::vector<char> bytes = packed(number, film);
  const std::lock_guard lock(mutex_);
  Sending& sending = sending_[next_sending_];
  next_sending_ = 1 - next_sending_;
  MPI_Wait(&sending.request, MPI_STATUS_IGNORE);
  sending.bytes = std::move(bytes);
  MPI_Isend(sending.bytes.data(), static_cast<int>(sending.bytes.size()), MPI_BYTE, 0, kTile, comm_, &sending.request);
}

void MpiCommunicator::end_giving(const cli::WorkOfRank& work, bool failed) {
  const std::vector<char> end = packed(EndOfRank{work, failed});
  const std::lock_guard lock(mutex_);
  for (Sending& sending : sending_) MPI_Wait(&sending.request, MPI_STATUS_IGNORE);
  if (awaits_number_) MPI_Wait(&number_request_, MPI_STATUS_IGNORE);
  awaits_number_ = false;
  MPI_Send(end.data(), static_cast<int>(end.size()), MPI_BYTE, 0, kEnd, comm_);
}

// Starts to receive a message, and takes what has arrived. Returns whether one had. `wait`: blocks until then.
bool MpiCommunicator::receive_one(bool wait) {
  int there = 1;
  MPI_Status status;
  if (wait && receiving_.empty())
    MPI_Probe(MPI_ANY_SOURCE, MPI_ANY_TAG, comm_, &status);
  else
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, comm_, &there, &status);
  if (there != 0) {
    int count = 0;
    MPI_Get_count(&status, MPI_BYTE, &count);
    Receiving& one = receiving_.emplace_back(
        Receiving{status.MPI_SOURCE, status.MPI_TAG, std::vector<char>(static_cast<std::size_t>(count))});
    MPI_Irecv(one.bytes.data(), count, MPI_BYTE, one.source, one.tag, comm_, &one.request);
  }
  for (auto one = receiving_.begin(); one != receiving_.end();) {
    int arrived = 0;
    MPI_Test(&one->request, &arrived, MPI_STATUS_IGNORE);
    if (arrived == 0) {
      ++one;
      continue;
    }
    take_message(one->source, one->tag, one->bytes);
    one = receiving_.erase(one);
  }
  return there != 0;
}

// From many ranks many messages arrive while this one draws a tile.
void MpiCommunicator::receive_all() {
  while (receive_one(/*wait=*/false)) {
  }
}

void MpiCommunicator::take_message(int source, int tag, const std::vector<char>& bytes) {
  if (tag == kTile) {
    received_.push_back(unpacked_tile(bytes));
  } else if (tag == kAskNumber) {
    const std::int64_t number = counter_->add(1);
    MPI_Send(&number, 1, MPI_INT64_T, source, kNumber, comm_);
  } else {
    const EndOfRank end = unpacked_end(bytes);
    ++ended_;
    somebody_failed_ = somebody_failed_ || end.failed;
    work_of_others_.add(end.work);
  }
}

void MpiCommunicator::move_on() {
  const std::lock_guard lock(mutex_);
  if (rank_ == 0) return receive_all();
  for (Sending& sending : sending_) {
    int arrived = 0;
    MPI_Test(&sending.request, &arrived, MPI_STATUS_IGNORE);
  }
}

std::optional<cli::GivenTile> MpiCommunicator::take(bool wait) {
  const std::lock_guard lock(mutex_);
  receive_all();
  while (wait && received_.empty() && (ended_ < size_ - 1 || !receiving_.empty())) receive_one(/*wait=*/true);
  if (received_.empty()) return std::nullopt;
  cli::GivenTile first = std::move(received_.front());
  received_.pop_front();
  return first;
}

std::vector<Bytes> MpiCommunicator::all_gather(const Bytes& of_this_rank) {
  go_on_if_all_do();
  const std::lock_guard lock(mutex_);
  const auto own = static_cast<std::int64_t>(of_this_rank.size());
  std::vector<std::int64_t> sizes(static_cast<std::size_t>(size_));
  MPI_Allgather(&own, 1, MPI_INT64_T, sizes.data(), 1, MPI_INT64_T, comm_);
  std::vector<Bytes> all(sizes.size());
  const std::int64_t sum = std::accumulate(sizes.begin(), sizes.end(), std::int64_t{0});
  if (sum <= static_cast<std::int64_t>(kLongestMessage)) {
    std::vector<int> counts(sizes.begin(), sizes.end()), places(sizes.size());
    std::exclusive_scan(counts.begin(), counts.end(), places.begin(), 0);
    Bytes together(static_cast<std::size_t>(sum));
    MPI_Allgatherv(of_this_rank.data(), static_cast<int>(own), MPI_BYTE, together.data(), counts.data(), places.data(),
                   MPI_BYTE, comm_);
    for (std::size_t rank = 0; rank < all.size(); ++rank)
      all[rank].assign(together.begin() + places[rank], together.begin() + places[rank] + counts[rank]);
    return all;
  }
  for (int rank = 0; rank < size_; ++rank) {
    Bytes& bytes = all[static_cast<std::size_t>(rank)];
    if (rank == rank_) bytes = of_this_rank;
    bytes.resize(static_cast<std::size_t>(sizes[static_cast<std::size_t>(rank)]));
    for_each_message(bytes.data(), bytes.size(),
                     [&](char* first, int count) { MPI_Bcast(first, count, MPI_BYTE, rank, comm_); });
  }
  return all;
}

Bytes MpiCommunicator::broadcast(Bytes of_first) {
  go_on_if_all_do();
  const std::lock_guard lock(mutex_);
  auto size = static_cast<std::int64_t>(of_first.size());
  MPI_Bcast(&size, 1, MPI_INT64_T, 0, comm_);
  of_first.resize(static_cast<std::size_t>(size));
  for_each_message(of_first.data(), of_first.size(),
                   [this](char* first, int count) { MPI_Bcast(first, count, MPI_BYTE, 0, comm_); });
  return of_first;
}

void MpiCommunicator::all_reduce_max(std::vector<double>& numbers) {
  go_on_if_all_do();
  const std::lock_guard lock(mutex_);
  MPI_Allreduce(MPI_IN_PLACE, numbers.data(), static_cast<int>(numbers.size()), MPI_DOUBLE, MPI_MAX, comm_);
}

std::vector<Bytes> MpiCommunicator::all_to_all(const std::vector<Bytes>& for_each_rank) {
  go_on_if_all_do();
  const std::lock_guard lock(mutex_);
  std::vector<std::int64_t> sizes, coming(for_each_rank.size());
  for (const Bytes& bytes : for_each_rank) sizes.push_back(static_cast<std::int64_t>(bytes.size()));
  MPI_Alltoall(sizes.data(), 1, MPI_INT64_T, coming.data(), 1, MPI_INT64_T, comm_);
  std::vector<Bytes> got(for_each_rank.size());
  std::vector<MPI_Request> requests;
  for (int rank = 0; rank < size_; ++rank) {
    Bytes& bytes = got[static_cast<std::size_t>(rank)];
    const Bytes& given = for_each_rank[static_cast<std::size_t>(rank)];
    if (rank == rank_) {
      bytes = given;
      continue;
    }
    bytes.resize(static_cast<std::size_t>(coming[static_cast<std::size_t>(rank)]));
    for_each_message(bytes.data(), bytes.size(), [&](char* first, int count) {
      MPI_Irecv(first, count, MPI_BYTE, rank, kScattered, comm_, &requests.emplace_back());
    });
    for_each_message(const_cast<char*>(given.data()), given.size(), [&](char* first, int count) {
      MPI_Isend(first, count, MPI_BYTE, rank, kScattered, comm_, &requests.emplace_back());
    });
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  return got;
}

std::unique_ptr<cli::TileChannel> MpiCommunicator::open_channel(std::function<Bytes(const Bytes&)> answer,
                                                                int threads) {
  return std::make_unique<MpiChannel>(comm_, std::move(answer), threads);
}

}  // namespace bihive::mpi
