// The comment of a frame of extended XYZ [ExtXYZ]: keys and values.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bihive/geometry/cell.h"

namespace bihive {

/// Blanks may stand around the equals sign, keys and values in quotes, values in braces or brackets. Any other text is
/// passed over: the comment of a plain file may hold anything.
class XyzComment {
 public:
  explicit XyzComment(std::string_view line);

  /// The first value of a key, which is given in lower case, without its outer quotes, braces or brackets.
  std::optional<std::string_view> find(std::string_view key) const;
  /// The first of several keys, in the comment's order.
  std::optional<std::string_view> find_any(std::initializer_list<std::string_view> keys) const;
  /// Where the line stops making sense, from 1: a quote or bracket is never closed, or text follows it without a blank.
  std::optional<std::size_t> unclear_at() const { return unclear_at_; }

 private:
  std::vector<std::pair<std::string, std::string>> entries_;  // keys in lower case
  std::optional<std::size_t> unclear_at_;
};

/// The numbers of a vector or matrix, row after row: "1 2 3", "1, 2, 3", "[1, 2], [3, 4]". Nothing: something in it is
/// no finite number.
std::optional<std::vector<double>> xyz_numbers(std::string_view value);

/// Three truths: "T T F", "[True, True, False]", "1 1 0". Nothing: they are others.
std::optional<std::array<bool, 3>> xyz_flags(std::string_view value);

}  // namespace bihive
