#include "bihive/spread/remote_spheres.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <unordered_map>
#include <utility>

namespace bihive {
namespace {

constexpr double kFarthest = std::numeric_limits<double>::infinity();

}  // namespace

// The ranks that each ray may meet.
void RemoteSpheres::find_ways(const RaySpan& rays) {
  ways_.clear();
  const auto count = static_cast<std::size_t>(rays.count);
  next_.resize(count);
  end_.resize(count);
  ends_.resize(count);
  number_of_rank_.resize(static_cast<std::size_t>(boxes_.ranks()), -1);
  for (std::size_t i = 0; i < count; ++i) {
    const Ray ray = rays.at(static_cast<std::int64_t>(i));
    next_[i] = ways_.size();
    ends_[i] = ray.t_max;
    if (is_valid(ray)) boxes_.find(ray, ways_);
    end_[i] = ways_.size();
  }
  counts_.rays += rays.count;
}

RemoteSpheres::RaysOfRank& RemoteSpheres::rays_of(int rank) {
  std::int32_t& number = number_of_rank_[static_cast<std::size_t>(rank)];
  if (number < 0) {
    number = static_cast<std::int32_t>(asked_.size());
    asked_.push_back({rank, {}, {}, {}});
  }
  return asked_[static_cast<std::size_t>(number)];
}

// The sphere on which a ray starts is on one rank, with all that coincide with it.
void RemoteSpheres::choose(const RaySpan& rays, std::int64_t ray, int rank) {
  RaysOfRank& asked = rays_of(rank);
  asked.chosen.push_back(ray);
  const Address left = rays.leaves != nullptr ? seen_.address_of(rays.leaves[ray]) : Address{-1, kNoPlace};
  asked.places.push_back(left.rank == rank ? left.place : kNoPlace);
  const bool is_ghost = left.rank >= 0 && left.rank != rank && !seen_.scene().clips.empty();
  asked.ghosts.push_back(is_ghost ? seen_.whole_id_of(rays.leaves[ray]) : kNothing);
}

// Each ray that may still find something nearer goes to its next rank. False: none does.
bool RemoteSpheres::choose_next(const RaySpan& rays) {
  for (std::int64_t i = 0; i < rays.count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (next_[k] == end_[k] || ways_[next_[k]].t > ends_[k]) continue;
    choose(rays, i, ways_[next_[k]++].rank);
  }
  return !asked_.empty();
}

// The rays for this rank's own spheres.
RaySpan RemoteSpheres::rays_here(const RaySpan& rays, const RaysOfRank& asked) {
  const std::size_t count = asked.chosen.size();
  const auto gather = [&](auto& to, const auto& of) {
    to.resize(count);
    for (std::size_t k = 0; k < count; ++k) to[k] = of(asked.chosen[k]);
  };
  for (int axis = 0; axis < 3; ++axis) {
    gather(batch_.origin[axis], [&](std::int64_t i) { return rays.origin[axis][i]; });
    gather(batch_.direction[axis], [&](std::int64_t i) { return rays.direction[axis][i]; });
  }
  gather(batch_.t_min, [&](std::int64_t i) { return rays.t_min != nullptr ? rays.t_min[i] : 0; });
  gather(batch_.t_max, [&](std::int64_t i) { return ends_[static_cast<std::size_t>(i)]; });
  gather(batch_.inside, [&](std::int64_t i) { return rays.inside != nullptr ? rays.inside[i] : std::uint8_t{0}; });
  batch_.leaves.resize(count);
  for (std::size_t k = 0; k < count; ++k)
    batch_.leaves[k] = asked.ghosts[k] != kNothing   ? here_.place_of_ghost(asked.ghosts[k])
                       : asked.places[k] == kNoPlace ? kNothing
                                                     : static_cast<std::int64_t>(asked.places[k]);
  return batch_.span();
}

// Sends the chosen rays, and calls use(rays of a rank, span of them here or null, answer or null) for each rank.
template <class Use>
void RemoteSpheres::ask(QuestionKind kind, WhichSpheres which, RayOrder order, const RaySpan& rays, const Use& use) {
  std::vector<RankChannel::Question> questions;
  for (const RaysOfRank& asked : asked_) {
    counts_.asked += static_cast<std::int64_t>(asked.chosen.size());
    if (asked.rank == channel_.rank()) continue;
    questions.push_back(
        {asked.rank, rays_question(kind, which, order, {&rays, &asked.chosen, &asked.places, &asked.ghosts, &ends_})});
    counts_.bytes += static_cast<std::int64_t>(questions.back().bytes.size());
  }
  std::vector<Bytes> answers;
  if (!questions.empty()) {
    counts_.messages += 2 * static_cast<std::int64_t>(questions.size());
    ++counts_.rounds;
    answers = channel_.ask(std::move(questions));
    for (const Bytes& answer : answers) counts_.bytes += static_cast<std::int64_t>(answer.size());
  }
  std::size_t number = 0;
  for (const RaysOfRank& asked : asked_) {
    number_of_rank_[static_cast<std::size_t>(asked.rank)] = -1;
    if (asked.rank == channel_.rank()) {
      const RaySpan here = rays_here(rays, asked);
      use(asked, &here, nullptr);
    } else {
      use(asked, nullptr, &answers[number++]);
    }
  }
  asked_.clear();
}

// Fetches those spheres at these addresses that are not yet known.
void RemoteSpheres::know(const std::vector<Address>& addresses) {
  std::vector<std::vector<Address>> unknown;
  std::vector<Address> ordered;
  for (const Address& address : addresses)
    if (seen_.id_of(address) == kNothing) ordered.push_back(address);
  const auto before = [](const Address& a, const Address& b) {
    return a.rank != b.rank ? a.rank < b.rank : a.place < b.place;
  };
  std::sort(ordered.begin(), ordered.end(), before);
  ordered.erase(std::unique(ordered.begin(), ordered.end(),
                            [](const Address& a, const Address& b) { return a.rank == b.rank && a.place == b.place; }),
                ordered.end());
  for (const Address& address : ordered) {
    if (unknown.empty() || unknown.back().front().rank != address.rank) unknown.emplace_back();
    unknown.back().push_back(address);
  }

  std::vector<RankChannel::Question> questions;
  for (const std::vector<Address>& of_rank : unknown) {
    if (of_rank.front().rank == channel_.rank()) continue;
    Bytes question;
    ByteWriter out(question);
    out.put(QuestionKind::spheres);
    out.put(static_cast<std::int64_t>(of_rank.size()));
    for (const Address& address : of_rank) out.put(address.place);
    counts_.bytes += static_cast<std::int64_t>(question.size());
    questions.push_back({of_rank.front().rank, std::move(question)});
  }
  std::vector<Bytes> answers;
  if (!questions.empty()) {
    counts_.messages += 2 * static_cast<std::int64_t>(questions.size());
    ++counts_.rounds;
    answers = channel_.ask(std::move(questions));
  }
  std::size_t number = 0;
  for (const std::vector<Address>& of_rank : unknown) {
    Bytes own;
    if (of_rank.front().rank == channel_.rank()) {
      std::vector<std::int64_t> places;
      places.reserve(of_rank.size());
      for (const Address& address : of_rank) places.push_back(address.place);
      here_.pack(places, own);
    } else {
      counts_.bytes += static_cast<std::int64_t>(answers[number].size());
      own = std::move(answers[number++]);
    }
    ByteReader packed(own);
    seen_.add(of_rank, packed);
  }
}

void RemoteSpheres::closest_hits(WhichSpheres which, const RaySpan& rays, RayOrder order, const HitSpan& hits) {
  find_ways(rays);
  std::vector<Nearest> nearest(static_cast<std::size_t>(rays.count), {kFarthest, kNothing, {-1, kNoPlace}});
  std::vector<FoundSphere> found;
  while (choose_next(rays)) {
    ask(QuestionKind::closest, which, order, rays,
        [&](const RaysOfRank& asked, const RaySpan* here, const Bytes* answer) {
          if (here != nullptr)
            here_.closest_hits(which, *here, order, found);
          else
            found = take_found(*answer);
          for (const FoundSphere& one : found) {
            const auto i = static_cast<std::size_t>(asked.chosen[static_cast<std::size_t>(one.ray)]);
            Nearest& best = nearest[i];
            if (!(one.t < best.t || (one.t == best.t && one.whole_id < best.whole_id) || best.whole_id == kNothing))
              continue;
            best = {one.t, one.whole_id, {asked.rank, one.place}};
            ends_[i] = one.t;
          }
        });
  }
  std::vector<Address> addresses;
  for (const Nearest& one : nearest)
    if (one.whole_id != kNothing) addresses.push_back(one.address);
  know(addresses);
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    hits.t[i] = nearest[i].t;
    hits.sphere_id[i] = nearest[i].whole_id == kNothing ? kNothing : seen_.id_of(nearest[i].address);
  }
}

void RemoteSpheres::occluded(WhichSpheres which, const RaySpan& rays, RayOrder order, std::uint8_t* is_occluded) {
  find_ways(rays);
  std::fill_n(is_occluded, rays.count, std::uint8_t{0});
  std::vector<std::uint8_t> of_rank;
  while (choose_next(rays)) {
    ask(QuestionKind::occluded, which, order, rays,
        [&](const RaysOfRank& asked, const RaySpan* here, const Bytes* answer) {
          of_rank.resize(asked.chosen.size());
          if (here != nullptr)
            here_.occluded(which, *here, order, of_rank.data());
          else
            take_occluded(*answer, of_rank);
          for (std::size_t k = 0; k < of_rank.size(); ++k) {
            if (of_rank[k] == 0) continue;
            const auto i = static_cast<std::size_t>(asked.chosen[k]);
            is_occluded[i] = 1;
            next_[i] = end_[i];
          }
        });
  }
}

void RemoteSpheres::all_hits(WhichSpheres which, const RaySpan& rays, RayOrder order, std::vector<RayHit>& found) {
  find_ways(rays);
  for (std::int64_t i = 0; i < rays.count; ++i)
    for (std::size_t way = next_[static_cast<std::size_t>(i)]; way < end_[static_cast<std::size_t>(i)]; ++way)
      choose(rays, i, ways_[way].rank);
  struct Crossed {
    std::int64_t ray;
    double t;
    std::int64_t whole_id;
    Address address;
  };
  std::vector<Crossed> crossed;
  std::vector<FoundSphere> of_rank;
  ask(QuestionKind::all_hits, which, order, rays,
      [&](const RaysOfRank& asked, const RaySpan* here, const Bytes* answer) {
        if (here != nullptr)
          here_.all_hits(which, *here, order, of_rank);
        else
          of_rank = take_found(*answer);
        for (const FoundSphere& one : of_rank)
          crossed.push_back(
              {asked.chosen[static_cast<std::size_t>(one.ray)], one.t, one.whole_id, {asked.rank, one.place}});
      });
  std::sort(crossed.begin(), crossed.end(), [](const Crossed& a, const Crossed& b) {
    if (a.ray != b.ray) return a.ray < b.ray;
    return a.t != b.t ? a.t < b.t : a.whole_id < b.whole_id;
  });
  std::vector<Address> addresses;
  addresses.reserve(crossed.size());
  for (const Crossed& one : crossed) addresses.push_back(one.address);
  know(addresses);
  found.clear();
  for (const Crossed& one : crossed) found.push_back({one.ray, one.t, seen_.id_of(one.address)});
}

}  // namespace bihive
