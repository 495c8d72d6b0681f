#include "bihive/base/near_name.h"

#include <algorithm>
#include <cstddef>

#include "bihive/base/ascii.h"

namespace bihive {
namespace {

// The number of letters to change, add, remove or swap with a neighbour [Damerau1964].
std::size_t letters_apart(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0U : 1U)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

}  // namespace

std::string near_name(std::string_view name, const std::vector<std::string>& candidates) {
  constexpr std::size_t kLongest = 64;
  if (name.size() > kLongest) return "";
  const std::string wanted = lower_case(name);
  std::string nearest;
  std::size_t least = std::min<std::size_t>(2, name.size() / 3 + 1) + 1;
  for (const std::string& candidate : candidates) {
    if (candidate.size() > kLongest || candidate.size() < 2) continue;
    const std::size_t apart = letters_apart(wanted, lower_case(candidate));
    if (apart >= least || apart >= candidate.size()) continue;
    least = apart;
    nearest = candidate;
  }
  return nearest;
}

}  // namespace bihive
