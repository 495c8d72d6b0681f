// Several processes have a part of a set each, and find out together what is true of the whole one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bihive {

/// Each function is for all processes at the same time, each in the same order. The parts follow each other: the first
/// process has the first spheres.
class SetParts {
 public:
  virtual ~SetParts() = default;
  virtual int part() const = 0;   ///< of this process, from 0
  virtual int count() const = 0;  ///< of parts

  /// Each number becomes the greatest of all processes' numbers at its place. As many on all.
  virtual void take_greatest(std::vector<double>& numbers) const = 0;
  /// The numbers of each process, in the order of the parts.
  virtual std::vector<std::vector<double>> gather(const std::vector<double>& numbers) const = 0;
};

/// The rows of a file that a process reads.
struct RowRange {
  std::int64_t first = 0, end = 0;
  std::int64_t count() const { return end - first; }
};
/// Part k of n has the rows from about rows * k / n on; `parts` null: all.
inline RowRange rows_of_part(const SetParts* parts, std::int64_t rows) {
  if (parts == nullptr) return {0, rows};
  const std::int64_t count = parts->count();
  const auto bound = [&](std::int64_t part) { return rows / count * part + rows % count * part / count; };
  return {bound(parts->part()), bound(parts->part() + 1)};
}

/// The same where there may be one process alone; `parts` null: it has the whole set.
inline void greatest_of_all(const SetParts* parts, std::vector<double>& numbers) {
  if (parts != nullptr) parts->take_greatest(numbers);
}
inline double greatest_of_all(const SetParts* parts, double number) {
  std::vector<double> one{number};
  greatest_of_all(parts, one);
  return one.front();
}

/// Counts of all parts: of those before this one, and of all. Exact up to 2^53.
struct CountOfParts {
  std::int64_t before = 0, all = 0;
};
inline CountOfParts count_of_all(const SetParts* parts, std::int64_t count) {
  if (parts == nullptr) return {0, count};
  CountOfParts sum;
  int part = 0;
  for (const std::vector<double>& one : parts->gather({static_cast<double>(count)})) {
    if (part++ < parts->part()) sum.before += static_cast<std::int64_t>(one.front());
    sum.all += static_cast<std::int64_t>(one.front());
  }
  return sum;
}

}  // namespace bihive
