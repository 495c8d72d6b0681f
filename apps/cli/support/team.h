// The processes that draw one picture together: the ranks of bihive-mpi. The program bihive is alone.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bihive/image/film.h"
#include "bihive/render/renderer.h"

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

class Team {
 public:
  virtual ~Team() = default;
  virtual int rank() const = 0;  ///< rank 0 writes the file, and speaks
  virtual int size() const = 0;

  /// All ranks come here. Fails on a rank that sees something else than rank 0; throws OtherRankFailed on the others,
  /// and on all that are well if a rank has failed before.
  virtual void agree(const std::vector<Fingerprint>& seen) = 0;

  /// The next number, which all ranks count together from 0. After stop_counting(), on any rank, numbers are beyond any
  /// picture.
  virtual std::int64_t next_number() = 0;
  virtual void stop_counting() = 0;

  /// Ranks above 0. Gives rows to rank 0; waits while two are on their way.
  virtual void give(std::int64_t number, const Film& film) = 0;
  /// The last that such a rank says of a picture.
  virtual void end_giving(const RenderCounts& rays, bool failed) = 0;

  /// Rank 0, from one thread at a time. Receives what has come.
  virtual void receive() = 0;
  /// Rank 0. The next rows that were received; nothing: none are there. `wait`: none will come.
  virtual std::optional<GivenRows> take(bool wait) = 0;
  virtual bool somebody_failed() const = 0;
  /// Rank 0, when all have ended: the rays of the others.
  virtual RenderCounts rays_of_others() const = 0;
};

/// Null: alone.
Team* team();
void set_team(Team* team);

/// Whether this process writes and speaks.
inline bool leads() {
  return team() == nullptr || team()->rank() == 0;
}

}  // namespace bihive::cli
