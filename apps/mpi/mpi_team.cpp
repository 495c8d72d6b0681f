#include "mpi_team.h"

#include <algorithm>
#include <climits>
#include <utility>

#include "mpi_conversation.h"
#include "mpi_messages.h"

namespace bihive::mpi {
namespace {

enum Tag : int { kRows = 1, kEnd = 2, kScattered = 3 };

// No message is longer, because MPI counts bytes with 31 bits.
constexpr std::size_t kLongestMessage = std::size_t{1} << 29;

// Calls use(bytes, count) for each message in which so many bytes go.
template <class Use>
void for_each_message(char* bytes, std::size_t count, const Use& use) {
  for (std::size_t first = 0; first < count; first += kLongestMessage)
    use(bytes + first, static_cast<int>(std::min(kLongestMessage, count - first)));
}

}  // namespace

MpiTeam::MpiTeam(bool distributes) : distributes_(distributes) {
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &machine);
  MPI_Comm_size(machine, &size_on_machine_);
  MPI_Comm_free(&machine);
  // The counter lies with rank 0. Epochs last as long as the team.
  MPI_Win_allocate(rank_ == 0 ? sizeof(std::int64_t) : 0, sizeof(std::int64_t), MPI_INFO_NULL, MPI_COMM_WORLD,
                   &counter_, &window_);
  if (rank_ == 0) *counter_ = 0;
  MPI_Barrier(MPI_COMM_WORLD);
  MPI_Win_lock_all(0, window_);
}

MpiTeam::~MpiTeam() {
  MPI_Win_unlock_all(window_);
  MPI_Win_free(&window_);
}

// The lowest rank that failed, and its code.
int MpiTeam::share(int code) {
  const std::lock_guard lock(mutex_);
  const int mine = code == 0 ? INT_MAX : rank_;
  int lowest = INT_MAX;
  MPI_Allreduce(&mine, &lowest, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  if (lowest == INT_MAX) return 0;
  MPI_Bcast(&code, 1, MPI_INT, lowest, MPI_COMM_WORLD);
  code_ = code;
  speaks_ = lowest == rank_;
  return code;
}

int MpiTeam::end_with(int code) {
  // After a failure everybody knows already.
  return code_ != 0 ? code_ : share(code);
}

// A rank that has failed says so in place of what all do together.
void MpiTeam::go_on_if_all_do() {
  if (const int code = share(0); code != 0) throw cli::OtherRankFailed{code};
}

void MpiTeam::agree(const std::vector<cli::Fingerprint>& seen) {
  go_on_if_all_do();
  if (seen.empty()) return;

  // Compare with rank 0.
  std::vector<std::uint64_t> wanted;
  wanted.reserve(seen.size());
  for (const cli::Fingerprint& one : seen) wanted.push_back(one.hash);
  {
    const std::lock_guard lock(mutex_);
    MPI_Bcast(wanted.data(), static_cast<int>(wanted.size()), MPI_UINT64_T, 0, MPI_COMM_WORLD);
  }
  std::string differs;
  for (std::size_t i = 0; i < seen.size() && differs.empty(); ++i)
    if (seen[i].hash != wanted[i]) differs = seen[i].what;
  const int code = share(differs.empty() ? 0 : cli::kBadInput);
  if (code == 0) return;
  if (differs.empty()) throw cli::OtherRankFailed{code};
  cli::fail({differs + " of rank " + std::to_string(rank_) + " is not that of rank 0", "", 0, 0,
             "give all ranks the same program and the same words"});
}

std::int64_t MpiTeam::next_number() {
  const std::lock_guard lock(mutex_);
  const std::int64_t one = 1;
  std::int64_t number = 0;
  MPI_Fetch_and_op(&one, &number, MPI_INT64_T, 0, 0, MPI_SUM, window_);
  MPI_Win_flush(0, window_);
  return number;
}

void MpiTeam::stop_counting() {
  const std::lock_guard lock(mutex_);
  const std::int64_t beyond = std::int64_t{1} << 40;
  std::int64_t before = 0;
  MPI_Fetch_and_op(&beyond, &before, MPI_INT64_T, 0, 0, MPI_SUM, window_);
  MPI_Win_flush(0, window_);
}

void MpiTeam::give(std::int64_t number, const Film& film) {
  std::vector<char> bytes = packed(number, film);
  const std::lock_guard lock(mutex_);
  Sending& sending = sending_[next_sending_];
  next_sending_ = 1 - next_sending_;
  MPI_Wait(&sending.request, MPI_STATUS_IGNORE);
  sending.bytes = std::move(bytes);
  MPI_Isend(sending.bytes.data(), static_cast<int>(sending.bytes.size()), MPI_BYTE, 0, kRows, MPI_COMM_WORLD,
            &sending.request);
}

void MpiTeam::end_giving(const cli::WorkOfRank& work, bool failed) {
  const std::vector<char> end = packed(EndOfRank{work, failed});
  const std::lock_guard lock(mutex_);
  for (Sending& sending : sending_) MPI_Wait(&sending.request, MPI_STATUS_IGNORE);
  MPI_Send(end.data(), static_cast<int>(end.size()), MPI_BYTE, 0, kEnd, MPI_COMM_WORLD);
}

// Whether there was a message.
bool MpiTeam::receive_one(bool wait) {
  int there = 1;
  MPI_Status status;
  if (wait)
    MPI_Probe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &status);
  else
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &status);
  if (there == 0) return false;
  int count = 0;
  MPI_Get_count(&status, MPI_BYTE, &count);
  std::vector<char> bytes(static_cast<std::size_t>(count));
  MPI_Recv(bytes.data(), count, MPI_BYTE, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  if (status.MPI_TAG == kRows) {
    received_.push_back(unpacked_rows(bytes));
    return true;
  }
  const EndOfRank end = unpacked_end(bytes);
  ++ended_;
  somebody_failed_ = somebody_failed_ || end.failed;
  work_of_others_.add(end.work);
  return true;
}

void MpiTeam::receive() {
  const std::lock_guard lock(mutex_);
  while (receive_one(/*wait=*/false)) {
  }
}

std::optional<cli::GivenRows> MpiTeam::take(bool wait) {
  const std::lock_guard lock(mutex_);
  while (receive_one(/*wait=*/false)) {
  }
  while (wait && received_.empty() && ended_ < size_ - 1) receive_one(/*wait=*/true);
  if (received_.empty()) return std::nullopt;
  cli::GivenRows first = std::move(received_.front());
  received_.pop_front();
  return first;
}

std::vector<Bytes> MpiTeam::gather(const Bytes& of_this_rank) {
  go_on_if_all_do();
  const std::lock_guard lock(mutex_);
  const auto own = static_cast<std::int64_t>(of_this_rank.size());
  std::vector<std::int64_t> sizes(static_cast<std::size_t>(size_));
  MPI_Allgather(&own, 1, MPI_INT64_T, sizes.data(), 1, MPI_INT64_T, MPI_COMM_WORLD);
  std::vector<Bytes> all(sizes.size());
  for (int rank = 0; rank < size_; ++rank) {
    Bytes& bytes = all[static_cast<std::size_t>(rank)];
    if (rank == rank_) bytes = of_this_rank;
    bytes.resize(static_cast<std::size_t>(sizes[static_cast<std::size_t>(rank)]));
    for_each_message(bytes.data(), bytes.size(),
                     [&](char* first, int count) { MPI_Bcast(first, count, MPI_BYTE, rank, MPI_COMM_WORLD); });
  }
  return all;
}

Bytes MpiTeam::from_first(Bytes of_first) {
  go_on_if_all_do();
  const std::lock_guard lock(mutex_);
  auto size = static_cast<std::int64_t>(of_first.size());
  MPI_Bcast(&size, 1, MPI_INT64_T, 0, MPI_COMM_WORLD);
  of_first.resize(static_cast<std::size_t>(size));
  for_each_message(of_first.data(), of_first.size(),
                   [](char* first, int count) { MPI_Bcast(first, count, MPI_BYTE, 0, MPI_COMM_WORLD); });
  return of_first;
}

void MpiTeam::take_greatest(std::vector<double>& numbers) {
  go_on_if_all_do();
  const std::lock_guard lock(mutex_);
  MPI_Allreduce(MPI_IN_PLACE, numbers.data(), static_cast<int>(numbers.size()), MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
}

std::vector<Bytes> MpiTeam::scatter(const std::vector<Bytes>& for_each_rank) {
  go_on_if_all_do();
  const std::lock_guard lock(mutex_);
  std::vector<std::int64_t> sizes, coming(for_each_rank.size());
  for (const Bytes& bytes : for_each_rank) sizes.push_back(static_cast<std::int64_t>(bytes.size()));
  MPI_Alltoall(sizes.data(), 1, MPI_INT64_T, coming.data(), 1, MPI_INT64_T, MPI_COMM_WORLD);
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
      MPI_Irecv(first, count, MPI_BYTE, rank, kScattered, MPI_COMM_WORLD, &requests.emplace_back());
    });
    for_each_message(const_cast<char*>(given.data()), given.size(), [&](char* first, int count) {
      MPI_Isend(first, count, MPI_BYTE, rank, kScattered, MPI_COMM_WORLD, &requests.emplace_back());
    });
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  return got;
}

std::unique_ptr<cli::Conversation> MpiTeam::converse(std::function<Bytes(const Bytes&)> answer, int threads) {
  return std::make_unique<MpiConversation>(std::move(answer), threads);
}

}  // namespace bihive::mpi
