// A scene whose spheres are divided among several ranks: for sets beyond the memory of one machine.
//
// Each rank keeps its spheres, their tree, and a scene without the others. Threads that draw have an Artist each, and
// ask other ranks through a RankChannel; their questions are answered by SpreadScene::answer(). Pictures have the bits
// of one process with all spheres, for any number of ranks.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/render_settings.h"
#include "bihive/scene/scene.h"
#include "bihive/spread/bytes.h"
#include "bihive/spread/channel.h"
#include "bihive/spread/communicator.h"

namespace bihive {

/// Statistics of the rays of a thread.
struct ChannelCounts {
  std::int64_t rays = 0;      ///< of queries
  std::int64_t asked = 0;     ///< rays times the ranks that traced them, this one included
  std::int64_t messages = 0;  ///< to other ranks and back
  std::int64_t bytes = 0;     ///< in these
  std::int64_t rounds = 0;    ///< times that a query waited for other ranks

  void add(const ChannelCounts& more) {
    rays += more.rays;
    asked += more.asked;
    messages += more.messages;
    bytes += more.bytes;
    rounds += more.rounds;
  }
};

/// Collective. Rank 0 passes a scene with its spheres; the others receive the same scene without spheres and copies
/// (spread/scene_bytes.h).
void give_all_spheres(Scene& scene, Communicator& ranks);

/// One rank's share of a scene. Const after make(); any number of threads may use it at a time.
class SpreadScene {
 public:
  ~SpreadScene();
  SpreadScene(const SpreadScene&) = delete;
  SpreadScene& operator=(const SpreadScene&) = delete;

  /// For all ranks at the same time. `scene`: the scene to draw, with the spheres that this rank has at first, which
  /// may be all, some or none; everything else is the same on all ranks. The spheres of rank 0 are the first of the
  /// whole set, those of rank 1 follow. `settings`: the picture's, the same on all ranks. Errors are returned after all
  /// collective calls: more spheres than a rank can number, or not enough memory for their tree. Copies of a replicated
  /// set are a programmer's error (refusal()).
  static Result<std::shared_ptr<const SpreadScene>> make(Scene scene, const RenderSettings& settings,
                                                         const TreeParameters& parameters, Communicator& ranks);
  /// The reason why this scene cannot be distributed with these settings.
  static Status refusal(const Scene& scene, const RenderSettings& settings);

  std::int64_t size() const;        ///< spheres of this rank
  std::int64_t whole_size() const;  ///< of all
  double build_ms() const;

  /// The answer to any question that a RankChannel brings.
  Bytes answer(const Bytes& question) const;

  /// For one thread.
  class Artist {
   public:
    virtual ~Artist() = default;
    virtual const Scene& scene() const = 0;
    virtual const Tracer& tracer() const = 0;
    /// Releases memory, between two pictures or tiles of one.
    virtual void rest() = 0;
    virtual ChannelCounts counts() const = 0;
  };
  /// The scene and the channel must outlive it.
  std::unique_ptr<Artist> artist(RankChannel& channel) const;

 private:
  SpreadScene();
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace bihive
