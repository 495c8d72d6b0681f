#include "film/picture_index.h"

#include <cstddef>

#include "film/content_hash.h"

namespace bihive::cli {
namespace {

constexpr std::string_view kHead = "bihive film index 1 ";
constexpr std::string_view kIndexName = "film.", kIndexEnding = "index";

std::optional<std::uint64_t> from_decimal(std::string_view digits) {
  if (digits.empty() || digits.size() > 18) return std::nullopt;
  std::uint64_t number = 0;
  for (const char c : digits) {
    if (c < '0' || c > '9') return std::nullopt;
    number = 10 * number + static_cast<std::uint64_t>(c - '0');
  }
  return number;
}

std::optional<IndexEntry> entry_of(std::string_view line) {
  const std::size_t first = line.find(' ');
  if (first == std::string_view::npos) return std::nullopt;
  const std::size_t second = line.find(' ', first + 1);
  if (second == std::string_view::npos) return std::nullopt;
  const auto number = from_decimal(line.substr(0, first));
  const auto size = from_decimal(line.substr(first + 1, second - first - 1));
  const auto hash = hash_from_text(line.substr(second + 1));
  if (!number || !size || !hash) return std::nullopt;
  return IndexEntry{static_cast<std::int64_t>(*number), *size, *hash};
}

}  // namespace

std::string index_head(std::uint64_t film) {
  return std::string(kHead) + hash_text(film) + "\n";
}

std::string index_line(const IndexEntry& entry) {
  return std::to_string(entry.number) + " " + std::to_string(entry.size) + " " + hash_text(entry.hash) + "\n";
}

std::size_t whole_lines(std::string_view text) {
  const std::size_t last = text.rfind('\n');
  return last == std::string_view::npos ? 0 : last + 1;
}

std::optional<PictureIndex> read_index(std::string_view text, std::uint64_t film) {
  // A kill may have truncated the first line.
  if (text.substr(0, kHead.size()) != kHead.substr(0, text.size())) return std::nullopt;
  text = text.substr(0, whole_lines(text));
  const std::string own_head = index_head(film);
  PictureIndex index;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    if (line.substr(0, kHead.size()) == kHead)
      index.ends_with_own = line == std::string_view(own_head).substr(0, own_head.size() - 1);
    else if (const std::optional<IndexEntry> entry = entry_of(line))
      (index.ends_with_own ? index.own : index.earlier).push_back(*entry);
    text.remove_prefix(line.size() + 1);
  }
  return index;
}

std::string index_name(const std::string& prefix, std::int64_t shard, std::int64_t shards) {
  std::string name = prefix + std::string(kIndexName);
  if (shards > 1) name += std::to_string(shard) + "-" + std::to_string(shards) + ".";
  return name + std::string(kIndexEnding);
}

bool is_index_name(const std::string& prefix, const std::string& name) {
  const std::string begin = prefix + std::string(kIndexName);
  if (name.size() < begin.size() + kIndexEnding.size() || name.compare(0, begin.size(), begin) != 0) return false;
  std::string_view rest = std::string_view(name).substr(begin.size());
  if (rest.substr(rest.size() - kIndexEnding.size()) != kIndexEnding) return false;
  rest.remove_suffix(kIndexEnding.size());
  if (rest.empty()) return true;
  if (rest.back() != '.') return false;
  rest.remove_suffix(1);
  const std::size_t dash = rest.find('-');
  return dash != std::string_view::npos && from_decimal(rest.substr(0, dash)) && from_decimal(rest.substr(dash + 1));
}

}  // namespace bihive::cli
