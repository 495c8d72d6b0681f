// Ranks that are threads of one process: for tests, and to learn what a picture costs on many ranks without having
// them.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/scene/render_settings.h"
#include "bihive/scene/scene.h"
#include "bihive/spread/channel.h"
#include "bihive/spread/communicator.h"
#include "bihive/spread/spread_scene.h"

namespace bihive {

/// Which spheres a rank has before they are distributed.
enum class FirstSpheres {
  all_on_rank_0,
  in_order,  ///< each rank has some that follow each other
};

/// Calls `work` on a thread for each rank, and waits for their end. A rank that leaves out a collective call of the
/// others keeps them waiting for ever.
void on_ranks_in_process(int ranks, const std::function<void(Communicator&)>& work);

class RanksInProcess {
 public:
  virtual ~RanksInProcess() = default;
  /// Distributes the spheres of `whole`, with a thread for each rank. Errors as those of SpreadScene::make().
  static Result<std::unique_ptr<RanksInProcess>> make(const Scene& whole, const RenderSettings& settings,
                                                      const TreeParameters& parameters, int ranks, FirstSpheres first);

  virtual int size() const = 0;
  virtual const SpreadScene& scene(int rank) const = 0;
  /// Bytes of spheres and samples that the rank sent while the spheres were distributed.
  virtual std::int64_t sent_bytes(int rank) const = 0;

  /// What `rank` asks is answered on the thread that asks, at once. Threads may ask at the same time. Must not outlive
  /// this object.
  virtual std::unique_ptr<RankChannel> channel(int rank) = 0;
};

}  // namespace bihive
