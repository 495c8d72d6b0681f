// Ranks simulated by threads of one process: for tests, and to measure the cost of a picture on many ranks.
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

/// The spheres of a rank before they are distributed.
enum class FirstSpheres {
  all_on_rank_0,
  in_order,  ///< each rank has consecutive spheres
};

/// Calls `work` on a thread per rank, and joins them. A rank that misses a collective call of the others blocks them
/// forever.
void on_ranks_in_process(int ranks, const std::function<void(Communicator&)>& work);

class RanksInProcess {
 public:
  virtual ~RanksInProcess() = default;
  /// Distributes the spheres of `whole`, with a thread per rank. Errors as those of SpreadScene::make().
  static Result<std::unique_ptr<RanksInProcess>> make(const Scene& whole, const RenderSettings& settings,
                                                      const TreeParameters& parameters, int ranks, FirstSpheres first);

  virtual int size() const = 0;
  virtual const SpreadScene& scene(int rank) const = 0;
  /// Bytes of spheres and samples that the rank sent while the spheres were distributed.
  virtual std::int64_t sent_bytes(int rank) const = 0;

  /// Questions of `rank` are answered at once, on the calling thread. Threads may ask at the same time. Must not
  /// outlive this object.
  virtual std::unique_ptr<RankChannel> channel(int rank) = 0;
};

}  // namespace bihive
