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
#include "bihive/spread/exchange.h"
#include "bihive/spread/ranks.h"
#include "bihive/spread/spread_scene.h"

namespace bihive::cli {

/// A thing that all ranks must see alike, "the input", and a hash of it.
struct Fingerprint {
  std::string what;
  std::uint64_t hash;
};

/// The light of some rows.
struct GivenRows {
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
  ExchangeCounts cost;  ///< where spheres are distributed

  void add(const WorkOfRank& other) {
    rays.primary += other.rays.primary;
    rays.shadow += other.rays.shadow;
    rays.reflected += other.rays.reflected;
    rays.transmitted += other.rays.transmitted;
    rays.ambient += other.rays.ambient;
    cost.add(other.cost);
  }
};

/// The bands of a picture on their way from the threads that draw to rank 0, which writes.
class BandTraffic {
 public:
  virtual ~BandTraffic() = default;
  /// The next number, which all ranks count together from 0. After stop_counting(), on any rank, numbers are beyond any
  /// picture.
  virtual std::int64_t next_number() = 0;
  virtual void stop_counting() = 0;

  /// Gives rows to rank 0; waits while too many are on their way.
  virtual void give(std::int64_t number, const Film& film) = 0;
  /// Ranks above 0. The last that such a rank says of a picture.
  virtual void end_giving(const WorkOfRank& work, bool failed) = 0;

  /// Rank 0. The next rows that were received; nothing: none are there. `wait`: none will come.
  virtual std::optional<GivenRows> take(bool wait) = 0;
  virtual bool somebody_failed() const = 0;
  /// Rank 0, when all have ended.
  virtual WorkOfRank work_of_others() const = 0;
};

/// Ranks talk like this while they draw spheres that are distributed over them. Any number of threads may use
/// it at a time, from begin() to end().
class Conversation : public Exchange, public BandTraffic {
 public:
  virtual void begin() = 0;
  /// Rank 0, whose own threads give rows too, says by it that none will come.
  virtual void end_own_giving() = 0;
  /// Comes back when all ranks have come here.
  virtual void end() = 0;
};

class Team : public Ranks, public BandTraffic {
 public:
  /// Whether the spheres are distributed over the ranks.
  virtual bool distributes() const = 0;
  /// `answer` answers the questions of other ranks, on `threads` threads. All ranks make one at the same time.
  virtual std::unique_ptr<Conversation> converse(std::function<Bytes(const Bytes&)> answer, int threads) = 0;

  /// All ranks come here. Fails on a rank that sees something else than rank 0; throws OtherRankFailed on the others,
  /// and on all that are well if a rank has failed before.
  virtual void agree(const std::vector<Fingerprint>& seen) = 0;

  /// Rank 0, from one thread at a time. Receives what has come.
  virtual void receive() = 0;
};

/// Null: alone.
Team* team();
void set_team(Team* team);

/// Whether this process writes and speaks.
inline bool leads() {
  return team() == nullptr || team()->rank() == 0;
}

}  // namespace bihive::cli
