// The processes that draw one picture together: the ranks of bihive-mpi. The program bihive is alone.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bihive/image/film.h"
#include "bihive/render/renderer.h"
#include "bihive/spread/bytes.h"
#include "bihive/spread/channel.h"
#include "bihive/spread/communicator.h"
#include "bihive/spread/spread_scene.h"

namespace bihive::cli {

/// Something that all ranks must see alike, such as "the input", and its hash.
struct Fingerprint {
  std::string what;
  std::uint64_t hash;
};

/// The radiance of a tile of a picture.
struct GivenTile {
  std::int64_t number;
  Film film;
};

/// Thrown on the working ranks when another one has failed and reports why.
struct OtherRankFailed {
  int code;
};

/// The work of a rank for a picture.
struct WorkOfRank {
  RenderCounts rays;
  ChannelCounts cost;  ///< with distributed spheres

  void add(const WorkOfRank& other) {
    rays.primary += other.rays.primary;
    rays.shadow += other.rays.shadow;
    rays.reflected += other.rays.reflected;
    rays.transmitted += other.rays.transmitted;
    rays.ambient += other.rays.ambient;
    cost.add(other.cost);
  }
};

/// Sends the tiles of a picture from the drawing threads to rank 0, which writes.
class TileTraffic {
 public:
  virtual ~TileTraffic() = default;
  /// The next number of a counter shared by all ranks, from 0. After stop_counting(), on any rank, numbers are beyond
  /// any picture.
  virtual std::int64_t next_number() = 0;
  virtual void stop_counting() = 0;

  /// Sends a tile to rank 0; waits while too many are in flight.
  virtual void give(std::int64_t number, const Film& film) = 0;
  /// Ranks above 0: the last message about a picture.
  virtual void end_giving(const WorkOfRank& work, bool failed) = 0;

  /// Rank 0: the next received tile; nothing: none is there. `wait`: blocks; then nothing means that none will come.
  virtual std::optional<GivenTile> take(bool wait) = 0;
  virtual bool somebody_failed() const = 0;
  /// Rank 0, when all have ended.
  virtual WorkOfRank work_of_others() const = 0;
};

/// The channel of ranks that draw distributed spheres. Any number of threads may use it at a time, from begin() to
/// end().
class TileChannel : public RankChannel, public TileTraffic {
 public:
  virtual void begin() = 0;
  /// Rank 0, whose own threads send tiles too, states that no more will come.
  virtual void end_own_giving() = 0;
  /// Collective. Returns when all ranks have called it.
  virtual void end() = 0;
};

/// The ranks of bihive-mpi, or some of them, that draw a picture together.
class PictureCommunicator : public Communicator, public TileTraffic {
 public:
  /// Whether the spheres are distributed over the ranks.
  virtual bool distributes() const = 0;
  /// `answer` answers the questions of other ranks, on `threads` threads. Collective.
  virtual std::unique_ptr<TileChannel> open_channel(std::function<Bytes(const Bytes&)> answer, int threads) = 0;

  /// Collective. Fails on a rank that sees something else than rank 0; throws OtherRankFailed on the others, and on all
  /// working ranks if a rank has failed before.
  virtual void agree(const std::vector<Fingerprint>& seen) = 0;
  /// Collective, at the end, unless a failed rank made the others leave another function. `code`: 0, or why this rank
  /// fails. Returns 0, or the code of the lowest rank that failed.
  virtual int end_with(int code) = 0;

  /// Collective. Throws OtherRankFailed if one has failed.
  virtual void barrier() = 0;
  /// Collective. The communicator of those that pass the same colour, in the order of these ranks.
  virtual std::unique_ptr<PictureCommunicator> split(int colour) = 0;
  /// Collective, before each shared picture: numbers begin at 0.
  virtual void begin_picture() = 0;

  /// Makes progress on messages of tiles. Ranks call it now and then while they draw, from one thread at a time.
  virtual void move_on() = 0;
};

/// Null: alone.
PictureCommunicator* communicator();
void set_communicator(PictureCommunicator* ranks);

/// Whether this process writes files and messages.
inline bool leads() {
  return communicator() == nullptr || communicator()->rank() == 0;
}

}  // namespace bihive::cli
