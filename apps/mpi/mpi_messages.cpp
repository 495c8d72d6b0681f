#include "mpi_messages.h"

namespace bihive::mpi {

std::vector<char> packed(std::int64_t number, const Film& film) {
  std::vector<char> bytes;
  ByteWriter out(bytes);
  out.put(number);
  out.put(std::int32_t{film.width});
  out.put(std::int32_t{film.height});
  out.put(std::int32_t{film.coverage.empty() ? 0 : 1});
  out.put_array(film.radiance.data(), film.radiance.size());
  out.put_array(film.coverage.data(), film.coverage.size());
  return bytes;
}

cli::GivenTile unpacked_tile(const std::vector<char>& bytes) {
  ByteReader in(bytes);
  cli::GivenTile tile{in.take<std::int64_t>(), {}};
  const auto width = in.take<std::int32_t>();
  const auto height = in.take<std::int32_t>();
  tile.film.resize(width, height, in.take<std::int32_t>() != 0);
  in.take_array(tile.film.radiance.data(), tile.film.radiance.size());
  in.take_array(tile.film.coverage.data(), tile.film.coverage.size());
  return tile;
}

std::vector<char> packed(const EndOfRank& end) {
  std::vector<char> bytes;
  ByteWriter(bytes).put(end);
  return bytes;
}

EndOfRank unpacked_end(const std::vector<char>& bytes) {
  return ByteReader(bytes).take<EndOfRank>();
}

}  // namespace bihive::mpi
