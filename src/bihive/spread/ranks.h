// The ranks of a program, as they work together before they draw.
#pragma once

#include <vector>

#include "bihive/spread/bytes.h"

namespace bihive {

/// Each function is for all ranks at the same time, each in the same order. It may throw if another rank has failed.
class Ranks {
 public:
  virtual ~Ranks() = default;
  virtual int rank() const = 0;
  virtual int size() const = 0;

  /// The bytes of each rank, in the order of the ranks.
  virtual std::vector<Bytes> gather(const Bytes& of_this_rank) = 0;
  /// The bytes of rank 0; those of the others do not matter.
  virtual Bytes from_first(Bytes of_first) = 0;
  /// Each number becomes the greatest of all ranks' numbers at its place. As many on all.
  virtual void take_greatest(std::vector<double>& numbers) = 0;
  /// The bytes of each rank for this one.
  virtual std::vector<Bytes> scatter(const std::vector<Bytes>& for_each_rank) = 0;
};

}  // namespace bihive
