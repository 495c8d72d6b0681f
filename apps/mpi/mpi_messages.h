// The bytes of what ranks send each other.
#pragma once

#include <cstdint>
#include <vector>

#include "support/communicator.h"

namespace bihive::mpi {

/// A tile of a picture, and the end of them.
std::vector<char> packed(std::int64_t number, const Film& film);
cli::GivenTile unpacked_tile(const std::vector<char>& bytes);

struct EndOfRank {
  cli::WorkOfRank work;
  bool failed;
};
std::vector<char> packed(const EndOfRank& end);
EndOfRank unpacked_end(const std::vector<char>& bytes);

}  // namespace bihive::mpi
