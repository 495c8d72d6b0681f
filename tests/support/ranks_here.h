// Ranks that are threads of one process.
#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "bihive/spread/exchange.h"
#include "bihive/spread/ranks.h"
#include "bihive/spread/spread_scene.h"

namespace bihive::test {

/// Where the threads meet.
class Meeting {
 public:
  explicit Meeting(int size) : size_(size), given_(static_cast<std::size_t>(size)) {}
  int size() const { return size_; }

  /// What all gave, rank by rank; waits for all.
  std::vector<std::vector<Bytes>> meet(int rank, std::vector<Bytes> gives) {
    std::unique_lock lock(mutex_);
    room_.wait(lock, [&] { return leaving_ == 0; });
    given_[static_cast<std::size_t>(rank)] = std::move(gives);
    if (++there_ == size_) {
      leaving_ = size_;
      room_.notify_all();
    } else {
      room_.wait(lock, [&] { return leaving_ > 0; });
    }
    std::vector<std::vector<Bytes>> all = given_;
    if (--leaving_ == 0) {
      there_ = 0;
      room_.notify_all();
    } else {
      room_.wait(lock, [&] { return leaving_ == 0; });
    }
    return all;
  }

 private:
  int size_;
  std::mutex mutex_;
  std::condition_variable room_;
  std::vector<std::vector<Bytes>> given_;
  int there_ = 0, leaving_ = 0;
};

class RankThread final : public Ranks {
 public:
  RankThread(int rank, Meeting& meeting) : rank_(rank), meeting_(meeting) {}
  int rank() const override { return rank_; }
  int size() const override { return meeting_.size(); }
  std::vector<Bytes> gather(const Bytes& own) override {
    std::vector<Bytes> all;
    for (std::vector<Bytes>& one : meeting_.meet(rank_, {own})) all.push_back(std::move(one.front()));
    return all;
  }
  Bytes from_first(Bytes of_first) override { return gather(of_first).front(); }
  void take_greatest(std::vector<double>& numbers) override {
    Bytes own;
    ByteWriter(own).put_array(numbers.data(), numbers.size());
    for (const Bytes& bytes : gather(own)) {
      std::vector<double> others(numbers.size());
      ByteReader(bytes).take_array(others.data(), others.size());
      for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = std::max(numbers[i], others[i]);
    }
  }
  std::vector<Bytes> scatter(const std::vector<Bytes>& for_each) override {
    std::vector<Bytes> mine;
    for (std::vector<Bytes>& one : meeting_.meet(rank_, for_each))
      mine.push_back(std::move(one[static_cast<std::size_t>(rank_)]));
    return mine;
  }

 private:
  int rank_;
  Meeting& meeting_;
};

/// What a rank asks is answered on its own thread, at once.
class LocalExchange final : public Exchange {
 public:
  LocalExchange(int rank, const std::vector<std::shared_ptr<const SpreadScene>>& scenes)
      : rank_(rank), scenes_(scenes) {}
  int rank() const override { return rank_; }
  int ranks() const override { return static_cast<int>(scenes_.size()); }
  std::vector<Bytes> ask(std::vector<Question> questions) override {
    std::vector<Bytes> answers;
    answers.reserve(questions.size());
    for (const Question& question : questions)
      answers.push_back(scenes_[static_cast<std::size_t>(question.rank)]->answer(question.bytes));
    return answers;
  }

 private:
  int rank_;
  const std::vector<std::shared_ptr<const SpreadScene>>& scenes_;
};

/// The scene with part `part` of `parts` of its spheres, which follow each other; with none if there is no such part.
Scene part_of_scene(const Scene& whole, int part, int parts);

}  // namespace bihive::test
