// The index of a sequence lists the pictures that bihive itself has written, so that an older file is not taken for one
// of them.
//
// A text file; a line is appended before each picture appears. The first line names the film; each other one has
// number, bytes and hash of a picture. A film that replaces another one appends its own name and pictures, so that the
// other's pictures are still known. A kill may truncate the last line, which is then ignored.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace bihive::cli {

struct IndexEntry {
  std::int64_t number = 0;
  std::uint64_t size = 0, hash = 0;

  bool operator==(const IndexEntry& other) const {
    return number == other.number && size == other.size && hash == other.hash;
  }
};

/// The line that names the film; `film`: hash of its description.
std::string index_head(std::uint64_t film);
std::string index_line(const IndexEntry& entry);

struct PictureIndex {
  std::vector<IndexEntry> own, earlier;  ///< of this film, and of others
  bool ends_with_own = false;            ///< an appended entry is one of this film
};
/// Nothing if it is no index. Malformed lines are ignored.
std::optional<PictureIndex> read_index(std::string_view text, std::uint64_t film);

/// The bytes of its whole lines.
std::size_t whole_lines(std::string_view text);

/// The name of the index: film.index, or film.3-16.index of shard 3 of 16.
std::string index_name(const std::string& prefix, std::int64_t shard, std::int64_t shards);
bool is_index_name(const std::string& prefix, const std::string& name);

}  // namespace bihive::cli
