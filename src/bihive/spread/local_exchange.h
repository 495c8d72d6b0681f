// An exchange between ranks that are all in this process: for tests, and to count what many ranks would say.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "bihive/spread/exchange.h"
#include "bihive/spread/part_of_set.h"

namespace bihive {

/// What rank `rank` asks is answered on its own thread, at once.
class LocalExchange final : public Exchange {
 public:
  LocalExchange(int rank, const std::vector<std::shared_ptr<const PartOfSet>>& parts) : rank_(rank), parts_(parts) {}

  int rank() const override { return rank_; }
  int ranks() const override { return static_cast<int>(parts_.size()); }
  std::vector<Bytes> ask(std::vector<Question> questions) override {
    std::vector<Bytes> answers;
    answers.reserve(questions.size());
    for (const Question& question : questions)
      answers.push_back(parts_[static_cast<std::size_t>(question.rank)]->answer(question.bytes));
    return answers;
  }

 private:
  int rank_;
  const std::vector<std::shared_ptr<const PartOfSet>>& parts_;
};

}  // namespace bihive
