// Traces the rays of one thread on the ranks whose spheres they may meet.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "bihive/render/remote_engine.h"
#include "bihive/spread/channel.h"
#include "bihive/spread/local_spheres.h"
#include "bihive/spread/rank_boxes.h"
#include "bihive/spread/seen_spheres.h"
#include "bihive/spread/spread_scene.h"

namespace bihive {

/// A ray goes to the ranks whose boxes it meets, the nearest first, and ends at its current nearest hit. Of all hits at
/// one t the smallest id in the whole set wins; so the answer is that of one process with all spheres.
class RemoteSpheres final : public RemoteEngine {
 public:
  /// `here`: this rank's spheres. All must outlive it.
  RemoteSpheres(SeenSpheres& seen, const RankBoxes& boxes, const LocalSpheres& here, RankChannel& channel)
      : seen_(seen), boxes_(boxes), here_(here), channel_(channel) {}

  void closest_hits(WhichSpheres which, const RaySpan& rays, RayOrder order, const HitSpan& hits) override;
  void occluded(WhichSpheres which, const RaySpan& rays, RayOrder order, std::uint8_t* is_occluded) override;
  void all_hits(WhichSpheres which, const RaySpan& rays, RayOrder order, std::vector<RayHit>& found) override;

  const ChannelCounts& counts() const { return counts_; }

 private:
  struct Nearest {
    double t;
    std::int64_t whole_id;
    Address address;
  };
  // The rays sent to a rank in one round.
  struct RaysOfRank {
    int rank;
    std::vector<std::int64_t> chosen;
    std::vector<Place> places;         // of the spheres on which they start
    std::vector<std::int64_t> ghosts;  // as in ChosenRays
  };

  void find_ways(const RaySpan& rays);
  RaysOfRank& rays_of(int rank);
  void choose(const RaySpan& rays, std::int64_t ray, int rank);
  bool choose_next(const RaySpan& rays);
  RaySpan rays_here(const RaySpan& rays, const RaysOfRank& asked);
  template <class Use>
  void ask(QuestionKind kind, WhichSpheres which, RayOrder order, const RaySpan& rays, const Use& use);
  void know(const std::vector<Address>& addresses);

  SeenSpheres& seen_;
  const RankBoxes& boxes_;
  const LocalSpheres& here_;
  RankChannel& channel_;
  ChannelCounts counts_;

  // State of the current query.
  std::vector<RankOnWay> ways_;    // ray after ray
  std::vector<std::size_t> next_;  // per ray: the next rank in ways_, and the end of its ranks
  std::vector<std::size_t> end_;
  std::vector<double> ends_;                  // per ray: its current end
  std::vector<RaysOfRank> asked_;             // of this round
  std::vector<std::int32_t> number_of_rank_;  // in asked_, or -1
  RayBatch batch_;
};

}  // namespace bihive
