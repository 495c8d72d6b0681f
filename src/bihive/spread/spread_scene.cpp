#include "bihive/spread/spread_scene.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <variant>

#include "bihive/base/setting_name.h"
#include "bihive/geometry/cut_sphere.h"
#include "bihive/geometry/stored_clip.h"
#include "bihive/scene/clips.h"
#include "bihive/spread/local_spheres.h"
#include "bihive/spread/proxies.h"
#include "bihive/spread/rank_boxes.h"
#include "bihive/spread/remote_spheres.h"
#include "bihive/spread/seen_spheres.h"
#include "bihive/spread/sphere_columns.h"
#include "bihive/spread/sphere_keys.h"

namespace bihive {
namespace {

// Minimum samples per rank by which the spheres are divided: then the largest of a thousand ranks has some 10 % more
// spheres than the mean.
constexpr std::int64_t kSamplesOfAll = 1 << 16;
constexpr std::int64_t kFewestSamples = 1 << 10;

// Spheres that a rank sends at a time, so that little memory is in use twice.
constexpr std::int64_t kSpheresAtOnce = 1 << 18;

// Maximum size of a thread's cache of seen spheres, which is then emptied.
constexpr std::int64_t kMostSeen = 1 << 22;

// The columns that the spheres of any rank have.
SphereColumns columns_of_all(const Scene& scene, Communicator& ranks) {
  SphereColumns has;
  for (const SphereColumns& one : ranks.all_gather_value(SphereColumns::of(scene))) {
    for (bool SphereColumns::*const column :
         {&SphereColumns::element, &SphereColumns::type, &SphereColumns::colour, &SphereColumns::opacity,
          &SphereColumns::outline, &SphereColumns::crease, &SphereColumns::clips, &SphereColumns::material,
          &SphereColumns::meaning, &SphereColumns::input_id})
      has.*column = has.*column || one.*column;
  }
  return has;
}

// The first key of each rank, from evenly spaced samples of all spheres. Rank 0 alone examines them: there may be more
// than another rank has spheres.
std::vector<SphereKey> common_starts(const SphereSet& spheres, std::int64_t whole_size, Communicator& ranks) {
  const std::int64_t samples_of_all = std::max(kSamplesOfAll, kFewestSamples * ranks.size());
  const std::int64_t step = std::max<std::int64_t>(1, whole_size / samples_of_all);
  std::vector<Bytes> for_each(static_cast<std::size_t>(ranks.size()));
  ByteWriter out(for_each.front());
  for (std::int64_t id = 0; id < spheres.size(); id += step) out.put(key_of(spheres, id));
  std::vector<SphereKey> samples;
  for (const Bytes& bytes : ranks.all_to_all(for_each)) {
    const std::size_t before = samples.size();
    samples.resize(before + bytes.size() / sizeof(SphereKey));
    ByteReader(bytes).take_array(samples.data() + before, samples.size() - before);
  }
  std::vector<SphereKey> starts = starts_of_ranks(std::move(samples), ranks.size());
  Bytes decided;
  ByteWriter(decided).put_array(starts.data(), starts.size());
  ByteReader(ranks.broadcast(std::move(decided))).take_array(starts.data(), starts.size());
  return starts;
}

// Some of a whole set's spheres.
struct SomeSpheres {
  Scene scene;
  std::vector<std::int64_t> whole_ids;
};

// Orders them by their ids in the whole set.
void sort_by_whole_id(SomeSpheres& spheres, const SphereColumns& has) {
  if (std::is_sorted(spheres.whole_ids.begin(), spheres.whole_ids.end())) return;
  std::vector<std::int64_t> order(spheres.whole_ids.size());
  std::iota(order.begin(), order.end(), std::int64_t{0});
  std::sort(order.begin(), order.end(), [&](std::int64_t a, std::int64_t b) {
    return spheres.whole_ids[static_cast<std::size_t>(a)] < spheres.whole_ids[static_cast<std::size_t>(b)];
  });
  order_spheres(order, has, spheres.scene, spheres.whole_ids);
}

// Sends all spheres to their ranks.
SomeSpheres sent(SomeSpheres had, const std::vector<SphereKey>& starts, const SphereColumns& has, const Scene& shell,
                 Communicator& ranks) {
  SomeSpheres got{shell, {}};
  const SphereSet& spheres = had.scene.spheres;
  const std::vector<std::int64_t> sizes = ranks.all_gather_value(spheres.size());
  const std::int64_t largest = *std::max_element(sizes.begin(), sizes.end());
  for (std::int64_t first = 0; first < largest; first += kSpheresAtOnce) {
    std::vector<std::vector<std::int64_t>> ids(static_cast<std::size_t>(ranks.size()));
    for (std::int64_t id = first; id < std::min(spheres.size(), first + kSpheresAtOnce); ++id)
      ids[static_cast<std::size_t>(rank_of(key_of(spheres, id), starts))].push_back(id);
    std::vector<Bytes> packed(ids.size());
    for (std::size_t rank = 0; rank < ids.size(); ++rank)
      if (!ids[rank].empty()) pack_spheres(had.scene, has, had.whole_ids, ids[rank], packed[rank]);
    for (const Bytes& bytes : ranks.all_to_all(packed)) {
      ByteReader reader(bytes);
      while (!reader.at_end()) append_spheres(reader, has, got.scene, got.whole_ids);
    }
  }
  had = {};
  sort_by_whole_id(got, has);
  return got;
}

// Ghost spheres. With cut spheres, the surface on which a ray starts may also be a cap of a remote sphere, in the same
// plane or on the same ball as a local one: each rank knows all cut spheres, and those that equal a clip.
std::vector<std::int64_t> possible_ghosts(const Scene& scene) {
  std::vector<std::int64_t> ids;
  const std::shared_ptr<const CutSet> cuts = cut_set_of(scene);
  for (std::int64_t id = 0; id < scene.spheres.size(); ++id) {
    bool matters = cuts != nullptr && cuts->is_cut(id);
    for (const Clip& clip : scene.clips)
      if (const auto* ball = std::get_if<SphereClip>(&clip)) {
        const StoredClip stored(*ball, scene.spheres);
        matters = matters || stored.is_ball(scene.spheres.stored_centre(id), scene.spheres.stored_radius(id));
      }
    if (matters) ids.push_back(id);
  }
  return ids;
}

// Adds the spheres of other ranks that matter here. Returns the previous number of spheres.
std::int64_t add_ghosts(SomeSpheres& own, const SphereColumns& has, const Scene& shell, Communicator& ranks) {
  const std::int64_t count = own.scene.spheres.size();
  if (!has.clips || shell.clips.empty()) return count;
  Bytes packed;
  pack_spheres(own.scene, has, own.whole_ids, possible_ghosts(own.scene), packed);
  const std::vector<Bytes> all = ranks.all_gather(packed);
  SomeSpheres ghosts{shell, {}};
  for (int rank = 0; rank < ranks.size(); ++rank) {
    if (rank == ranks.rank()) continue;
    ByteReader reader(all[static_cast<std::size_t>(rank)]);
    append_spheres(reader, has, ghosts.scene, ghosts.whole_ids);
  }
  sort_by_whole_id(ghosts, has);
  // Without a cut sphere, all spheres are whole or removed.
  const bool here = cut_set_of(own.scene) != nullptr;
  if (!here && cut_set_of(ghosts.scene) == nullptr) return count;
  packed.clear();
  std::vector<std::int64_t> ids(ghosts.whole_ids.size());
  std::iota(ids.begin(), ids.end(), std::int64_t{0});
  pack_spheres(ghosts.scene, has, ghosts.whole_ids, ids, packed);
  ByteReader reader(packed);
  append_spheres(reader, has, own.scene, own.whole_ids);
  return count;
}

// Those of all ranks together, in the order of the whole set.
Bytes common_proxies(const SomeSpheres& own, const RenderSettings& settings, const SphereColumns& has,
                     const Scene& shell, Communicator& ranks) {
  Bytes packed;
  pack_spheres(own.scene, has, own.whole_ids, proxies_of(own.scene, settings), packed);
  SomeSpheres all{shell, {}};
  for (const Bytes& bytes : ranks.all_gather(packed)) {
    ByteReader reader(bytes);
    append_spheres(reader, has, all.scene, all.whole_ids);
  }
  sort_by_whole_id(all, has);
  // Many ranks have many proxies; the proxies of these represent all.
  Bytes together;
  pack_spheres(all.scene, has, all.whole_ids, proxies_of(all.scene, settings), together);
  return together;
}

class ArtistOfScene final : public SpreadScene::Artist {
 public:
  ArtistOfScene(const Scene& shell, const SphereColumns& has, const Bytes& proxies, const RankBoxes& boxes,
                const LocalSpheres& here, RankChannel& channel)
      : seen_(shell, has, proxies),
        remote_(std::make_shared<RemoteSpheres>(seen_, boxes, here, channel)),
        tracer_(seen_.scene().spheres, remote_, cut_set_of(seen_.scene()) != nullptr) {}

  const Scene& scene() const override { return seen_.scene(); }
  const Tracer& tracer() const override { return tracer_; }
  void rest() override {
    if (seen_.count() > kMostSeen) seen_.forget();
  }
  ChannelCounts counts() const override { return remote_->counts(); }

 private:
  SeenSpheres seen_;
  std::shared_ptr<RemoteSpheres> remote_;
  Tracer tracer_;
};

}  // namespace

struct SpreadScene::Implementation {
  Scene shell;
  SphereColumns has;
  std::int64_t whole_size = 0;
  std::unique_ptr<RankBoxes> boxes;
  Bytes proxies;
  std::shared_ptr<const LocalSpheres> local;
};

void give_all_spheres(Scene& scene, Communicator& ranks) {
  const bool gives = ranks.rank() == 0;
  const Images images = ranks.broadcast_value(scene.spheres.images());
  const auto has = ranks.broadcast_value(SphereColumns::of(scene));
  const auto count = ranks.broadcast_value(scene.spheres.size());
  std::vector<std::int64_t> whole_ids;
  for (std::int64_t first = 0; first < count; first += kSpheresAtOnce) {
    Bytes packed;
    if (gives) {
      std::vector<std::int64_t> ids(static_cast<std::size_t>(std::min(kSpheresAtOnce, count - first)));
      std::iota(ids.begin(), ids.end(), first);
      pack_spheres(scene, has, {}, ids, packed);
    }
    packed = ranks.broadcast(std::move(packed));
    if (gives) continue;
    ByteReader reader(packed);
    append_spheres(reader, has, scene, whole_ids);
    whole_ids.clear();
  }
  // The units are those with copies already.
  if (!gives && images.count() > 1)
    BIHIVE_CHECK(static_cast<bool>(scene.spheres.replicate(images.vectors, images.counts)));
}

SpreadScene::SpreadScene() : implementation_(std::make_unique<Implementation>()) {}
SpreadScene::~SpreadScene() = default;

Status SpreadScene::refusal(const Scene& scene, const RenderSettings& settings) {
  if (scene.spheres.has_images())
    return Error{"copies of a replicated set cannot be distributed", "", 0, 0,
                 "leave out " + setting_name("replicate")};
  if (settings.view == View::tree || settings.view == View::traversal)
    return Error{"this view shows the tree of all spheres, and distributed spheres have a tree on each rank", "", 0, 0,
                 "leave out " + setting_name("distribute")};
  if (settings.stereo.form != StereoForm::none)
    return Error{"stereo pictures of distributed spheres are not drawn", "", 0, 0,
                 "leave out " + setting_name("distribute") + " or " + setting_name("stereo")};
  return Done{};
}

Result<std::shared_ptr<const SpreadScene>> SpreadScene::make(Scene scene, const RenderSettings& settings,
                                                             const TreeParameters& parameters, Communicator& ranks) {
  BIHIVE_CHECK(!scene.spheres.has_images());
  if (settings.opacity_rule == OpacityRule::as_one)
    return Error{setting_name("opacity_rule") + " as_one needs all spheres in one place, and they are distributed", "",
                 0, 0, "first counts the first of them"};
  std::shared_ptr<SpreadScene> made(new SpreadScene);
  Implementation& all = *made->implementation_;
  all.shell = without_spheres(scene);
  all.has = columns_of_all(scene, ranks);

  // Number all spheres, and send each to its rank.
  const std::vector<std::int64_t> sizes = ranks.all_gather_value(scene.spheres.size());
  all.whole_size = std::accumulate(sizes.begin(), sizes.end(), std::int64_t{0});
  std::vector<std::int64_t> whole_ids(static_cast<std::size_t>(scene.spheres.size()));
  std::iota(whole_ids.begin(), whole_ids.end(),
            std::accumulate(sizes.begin(), sizes.begin() + ranks.rank(), std::int64_t{0}));
  const std::vector<SphereKey> starts = common_starts(scene.spheres, all.whole_size, ranks);
  SomeSpheres own = sent({std::move(scene), std::move(whole_ids)}, starts, all.has, all.shell, ranks);

  // Exchange the boxes, and build.
  all.proxies = common_proxies(own, settings, all.has, all.shell, ranks);
  all.boxes = std::make_unique<RankBoxes>(ranks.all_gather_value(box_of(own.scene.spheres)), all.shell.spheres.scale());
  const std::int64_t count = add_ghosts(own, all.has, all.shell, ranks);
  Result<std::shared_ptr<const LocalSpheres>> part =
      LocalSpheres::make(std::move(own.scene), std::move(own.whole_ids), count, all.has, settings.opacity_rule,
                         parameters, settings.threads);
  if (!part) return part.error();
  all.local = std::move(*part);
  return std::shared_ptr<const SpreadScene>(std::move(made));
}

std::int64_t SpreadScene::size() const {
  return implementation_->local->size();
}
std::int64_t SpreadScene::whole_size() const {
  return implementation_->whole_size;
}
double SpreadScene::build_ms() const {
  return implementation_->local->build_ms();
}

Bytes SpreadScene::answer(const Bytes& question) const {
  return implementation_->local->answer(question);
}

std::unique_ptr<SpreadScene::Artist> SpreadScene::artist(RankChannel& channel) const {
  const Implementation& all = *implementation_;
  return std::make_unique<ArtistOfScene>(all.shell, all.has, all.proxies, *all.boxes, *all.local, channel);
}

}  // namespace bihive
