// Collective calls of the ranks of a program, with MPI's names.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "bihive/spread/bytes.h"

namespace bihive {

/// All ranks call each function at the same time, in the same order. It may throw if another rank has failed.
class Communicator {
 public:
  virtual ~Communicator() = default;
  virtual int rank() const = 0;  ///< from 0
  virtual int size() const = 0;

  /// The bytes of each rank, in the order of the ranks.
  virtual std::vector<Bytes> all_gather(const Bytes& of_this_rank) = 0;
  /// The bytes of rank 0; those of the others do not matter.
  virtual Bytes broadcast(Bytes of_rank_0) = 0;
  /// Each number becomes the maximum over all ranks at its position. The length is the same on all.
  virtual void all_reduce_max(std::vector<double>& numbers) = 0;
  /// The bytes of each rank for this one.
  virtual std::vector<Bytes> all_to_all(const std::vector<Bytes>& for_each_rank) = 0;

  /// The same for single values, and for lists of any length.
  double all_reduce_max(double number) {
    std::vector<double> one{number};
    all_reduce_max(one);
    return one.front();
  }
  template <class T>
  std::vector<T> all_gather_value(const T& value) {
    std::vector<T> values;
    for (const std::vector<T>& one : all_gather_list(std::vector<T>{value})) values.push_back(one.front());
    return values;
  }
  template <class T>
  std::vector<std::vector<T>> all_gather_list(const std::vector<T>& list) {
    Bytes own;
    ByteWriter(own).put_array(list.data(), list.size());
    std::vector<std::vector<T>> lists;
    for (const Bytes& bytes : all_gather(own)) {
      std::vector<T>& one = lists.emplace_back(bytes.size() / sizeof(T));
      ByteReader(bytes).take_array(one.data(), one.size());
    }
    return lists;
  }
  template <class T>
  T broadcast_value(const T& of_rank_0) {
    Bytes bytes;
    ByteWriter(bytes).put(of_rank_0);
    return ByteReader(broadcast(std::move(bytes))).take<T>();
  }
};

}  // namespace bihive
