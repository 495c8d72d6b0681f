#include "bihive/spread/ranks_in_process.h"

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <numeric>
#include <thread>
#include <utility>

#include "bihive/base/check.h"
#include "bihive/spread/communicator.h"
#include "bihive/spread/sphere_columns.h"

namespace bihive {
namespace {

// The bytes of each rank for each rank.
using Given = std::vector<std::vector<Bytes>>;

// The barrier of the threads.
class Meeting {
 public:
  explicit Meeting(int size) : size_(size) { begin(); }
  int size() const { return size_; }

  /// Waits for all. Valid while somebody holds it.
  std::shared_ptr<const Given> meet(int rank, std::vector<Bytes> gives) {
    std::unique_lock lock(mutex_);
    (*given_)[static_cast<std::size_t>(rank)] = std::move(gives);
    const std::int64_t number = number_;
    const std::shared_ptr<const Given> all = given_;
    if (++there_ == size_) {
      begin();
      ++number_;
      everybody_came_.notify_all();
    } else {
      everybody_came_.wait(lock, [&] { return number_ != number; });
    }
    return all;
  }

 private:
  void begin() {
    given_ = std::make_shared<Given>(static_cast<std::size_t>(size_));
    there_ = 0;
  }

  int size_;
  std::mutex mutex_;
  std::condition_variable everybody_came_;
  std::shared_ptr<Given> given_;
  int there_ = 0;
  std::int64_t number_ = 0;
};

class ThreadCommunicator final : public Communicator {
 public:
  ThreadCommunicator(int rank, Meeting& meeting) : rank_(rank), meeting_(meeting) {}
  int rank() const override { return rank_; }
  int size() const override { return meeting_.size(); }
  std::int64_t sent_bytes() const { return sent_bytes_; }

  std::vector<Bytes> all_gather(const Bytes& own) override {
    sent_bytes_ += static_cast<std::int64_t>(own.size()) * (size() - 1);
    const std::shared_ptr<const Given> given = meeting_.meet(rank_, {own});
    std::vector<Bytes> all;
    all.reserve(given->size());
    for (const std::vector<Bytes>& one : *given) all.push_back(one.front());
    return all;
  }

  Bytes broadcast(Bytes of_first) override {
    if (rank_ != 0) of_first.clear();
    return meeting_.meet(rank_, {std::move(of_first)})->front().front();
  }

  void all_reduce_max(std::vector<double>& numbers) override {
    Bytes own;
    ByteWriter(own).put_array(numbers.data(), numbers.size());
    const std::shared_ptr<const Given> given = meeting_.meet(rank_, {own});
    for (const std::vector<Bytes>& one : *given) {
      std::vector<double> others(numbers.size());
      ByteReader(one.front()).take_array(others.data(), others.size());
      for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = std::max(numbers[i], others[i]);
    }
  }

  std::vector<Bytes> all_to_all(const std::vector<Bytes>& for_each) override {
    for (std::size_t rank = 0; rank < for_each.size(); ++rank)
      if (static_cast<int>(rank) != rank_) sent_bytes_ += static_cast<std::int64_t>(for_each[rank].size());
    const std::shared_ptr<const Given> given = meeting_.meet(rank_, for_each);
    std::vector<Bytes> mine;
    mine.reserve(given->size());
    for (const std::vector<Bytes>& one : *given) mine.push_back(one[static_cast<std::size_t>(rank_)]);
    return mine;
  }

 private:
  int rank_;
  Meeting& meeting_;
  std::int64_t sent_bytes_ = 0;
};

void on_threads(int ranks, const std::function<void(ThreadCommunicator&)>& work) {
  Meeting meeting(ranks);
  std::vector<std::thread> threads;
  threads.reserve(static_cast<std::size_t>(ranks));
  for (int rank = 0; rank < ranks; ++rank)
    threads.emplace_back([&, rank] {
      ThreadCommunicator here(rank, meeting);
      work(here);
    });
  for (std::thread& thread : threads) thread.join();
}

// The scene with the spheres from `first` to before `end`.
Scene with_spheres(const Scene& whole, std::int64_t first, std::int64_t end) {
  std::vector<std::int64_t> ids(static_cast<std::size_t>(end - first));
  std::iota(ids.begin(), ids.end(), first);
  Bytes packed;
  pack_spheres(whole, SphereColumns::of(whole), {}, ids, packed);
  Scene made = without_spheres(whole);
  ByteReader reader(packed);
  ids.clear();
  append_spheres(reader, SphereColumns::of(whole), made, ids);
  return made;
}

struct Rank {
  std::shared_ptr<const SpreadScene> scene;
  std::int64_t sent_bytes = 0;
};

class ChannelInProcess final : public RankChannel {
 public:
  ChannelInProcess(int rank, const std::vector<Rank>& ranks) : rank_(rank), all_(ranks) {}
  int rank() const override { return rank_; }
  int ranks() const override { return static_cast<int>(all_.size()); }

  std::vector<Bytes> ask(std::vector<Question> questions) override {
    std::vector<Bytes> answers;
    answers.reserve(questions.size());
    for (const Question& question : questions)
      answers.push_back(all_[static_cast<std::size_t>(question.rank)].scene->answer(question.bytes));
    return answers;
  }

 private:
  int rank_;
  const std::vector<Rank>& all_;
};

class Implementation final : public RanksInProcess {
 public:
  explicit Implementation(int ranks) : ranks_(static_cast<std::size_t>(ranks)) {}

  Status distribute(const Scene& whole, const RenderSettings& settings, const TreeParameters& parameters,
                    FirstSpheres first) {
    std::vector<Status> failed(ranks_.size(), Done{});
    on_threads(size(), [&](ThreadCommunicator& here) {
      const int rank = here.rank();
      const std::int64_t count = whole.spheres.size();
      Scene scene = first == FirstSpheres::in_order
                        ? with_spheres(whole, count * rank / size(), count * (rank + 1) / size())
                        : with_spheres(whole, 0, rank == 0 ? count : 0);
      Result<std::shared_ptr<const SpreadScene>> made = SpreadScene::make(std::move(scene), settings, parameters, here);
      Rank& of_rank = ranks_[static_cast<std::size_t>(rank)];
      of_rank.sent_bytes = here.sent_bytes();
      if (made)
        of_rank.scene = std::move(*made);
      else
        failed[static_cast<std::size_t>(rank)] = made.error();
    });
    for (const Status& status : failed)
      if (!status) return status;
    return Done{};
  }

  int size() const override { return static_cast<int>(ranks_.size()); }
  const SpreadScene& scene(int rank) const override { return *of(rank).scene; }
  std::int64_t sent_bytes(int rank) const override { return of(rank).sent_bytes; }
  std::unique_ptr<RankChannel> channel(int rank) override { return std::make_unique<ChannelInProcess>(rank, ranks_); }

 private:
  const Rank& of(int rank) const { return ranks_[static_cast<std::size_t>(rank)]; }

  std::vector<Rank> ranks_;
};

}  // namespace

void on_ranks_in_process(int ranks, const std::function<void(Communicator&)>& work) {
  BIHIVE_CHECK_GE(ranks, 1);
  on_threads(ranks, work);
}

Result<std::unique_ptr<RanksInProcess>> RanksInProcess::make(const Scene& whole, const RenderSettings& settings,
                                                             const TreeParameters& parameters, int ranks,
                                                             FirstSpheres first) {
  BIHIVE_CHECK_GE(ranks, 1);
  auto made = std::make_unique<Implementation>(ranks);
  if (const Status status = made->distribute(whole, settings, parameters, first); !status) return status.error();
  return std::unique_ptr<RanksInProcess>(std::move(made));
}

}  // namespace bihive
