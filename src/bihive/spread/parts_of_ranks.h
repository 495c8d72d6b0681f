// The parts of a set that ranks read.
#pragma once

#include <vector>

#include "bihive/geometry/set_parts.h"
#include "bihive/spread/ranks.h"

namespace bihive {

class PartsOfRanks final : public SetParts {
 public:
  /// The ranks must outlive it.
  explicit PartsOfRanks(Ranks& ranks) : ranks_(ranks) {}
  int part() const override { return ranks_.rank(); }
  int count() const override { return ranks_.size(); }
  void take_greatest(std::vector<double>& numbers) const override { ranks_.take_greatest(numbers); }
  std::vector<std::vector<double>> gather(const std::vector<double>& numbers) const override {
    Bytes own;
    ByteWriter(own).put_array(numbers.data(), numbers.size());
    std::vector<std::vector<double>> all;
    for (const Bytes& bytes : ranks_.gather(own)) {
      std::vector<double>& one = all.emplace_back(bytes.size() / sizeof(double));
      ByteReader(bytes).take_array(one.data(), one.size());
    }
    return all;
  }

 private:
  Ranks& ranks_;
};

}  // namespace bihive
