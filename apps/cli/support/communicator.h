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

/// A thing that all ranks must see alike, "the input", and a hash of it.
struct Fingerprint {
  std::string what;
  std::uint64_t hash;
};

/// The light of a tile of a picture.
struct GivenTile {
  std::int64_t number;
  Film film;
};

/// Thrown on the ranks that are well when another one has failed and says why.
struct OtherRankFailed {
  int code;
};

/// The work of a rank for a picture.
struct WorkOfRank {
  RenderCounts rays;
  ChannelCounts cost;  ///< where spheres are distributed

  void add(const WorkOfRank& other) {
    rays.primary += other.rays.primary;
    rays.shadow += other.rays.shadow;
    rays.reflected += other.rays.reflected;
    rays.transmitted += other.rays.transmitted;
    rays.ambient += other.rays.ambient;
    cost.add(other.cost);
  }
};

/// The tiles of a picture on their way from the threads that draw to rank 0, which writes.
class TileTraffic {
 public:
  virtual ~TileTraffic() = default;
  /// The next number, which all ranks count together from 0. After stop_counting(), on any rank, numbers are beyond any
  /// picture.
  virtual std::int64_t next_number() = 0;
  virtual void stop_counting() = 0;

  /// Gives a tile to rank 0; waits while too many are on their way.
  virtual void give(std::int64_t number, const Film& film) = 0;
  /// Ranks above 0. The last that such a rank says of a picture.
  virtual void end_giving(const WorkOfRank& work, bool failed) = 0;

  /// Rank 0. The next tile that was received; nothing: none are there. `wait`: none will come.
  virtual std::optional<GivenTile> take(bool wait) = 0;
  virtual bool somebody_failed() const = 0;
  /// Rank 0, when all have ended.
  virtual WorkOfRank work_of_others() const = 0;
};

/// The channel of ranks that draw spheres which are distributed over them. Any number of threads may use it at a time,
/// from begin() to end().
class TileChannel : public RankChannel, public TileTraffic {
 public:
  virtual void begin() = 0;
  /// Rank 0, whose own threads give tiles too, says by it that none will come.
  virtual void end_own_giving() = 0;
  /// Comes back when all ranks have come here.
  virtual void end() = 0;
};

/// The ranks of bihive-mpi, or some of them, which draw a picture together.
class PictureCommunicator : public Communicator, public TileTraffic {
 public:
  /// Whether the spheres are distributed over the ranks.
  virtual bool distributes() const = 0;
  /// `answer` answers the questions of other ranks, on `threads` threads. All ranks make one at the same time.
  virtual std::unique_ptr<TileChannel> open_channel(std::function<Bytes(const Bytes&)> answer, int threads) = 0;

  /// All ranks come here. Fails on a rank that sees something else than rank 0; throws OtherRankFailed on the others,
  /// and on all that are well if a rank has failed before.
  virtual void agree(const std::vector<Fingerprint>& seen) = 0;
  /// All ranks come here at their end, unless a rank that failed made them leave another function. `code`: 0, or why
  /// this rank fails. Returns 0, or the code of the lowest rank that failed.
  virtual int end_with(int code) = 0;

  /// All ranks come here. Throws OtherRankFailed if one has failed.
  virtual void barrier() = 0;
  /// All ranks come here. The communicator of those that give the same colour, in the order of these ranks.
  virtual std::unique_ptr<PictureCommunicator> split(int colour) = 0;
  /// All ranks come here before each picture that they share: numbers begin at 0.
  virtual void begin_picture() = 0;

  /// Lets messages of tiles move on. Ranks call it now and then while they draw, from one thread at a time.
  virtual void move_on() = 0;
};

/// Null: alone.
PictureCommunicator* communicator();
void set_communicator(PictureCommunicator* ranks);

/// Whether this process writes and speaks.
inline bool leads() {
  return communicator() == nullptr || communicator()->rank() == 0;
}

}  // namespace bihive::cli
