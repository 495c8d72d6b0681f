// The spheres of other ranks that a thread which draws knows: those that its rays have met.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/scene/scene.h"
#include "bihive/spread/ray_messages.h"
#include "bihive/spread/sphere_columns.h"

namespace bihive {

/// A sphere on its rank.
struct Address {
  std::int32_t rank;
  Place place;
};

/// The scene has as its spheres those that stand for the whole set (spread/proxies.h), then those that were seen, in
/// the order in which they came. Their ids here mean nothing elsewhere.
class SeenSpheres {
 public:
  /// `shell`: the scene without spheres.
  SeenSpheres(Scene shell, const SphereColumns& has, const Bytes& proxies);
  SeenSpheres(const SeenSpheres&) = delete;
  SeenSpheres& operator=(const SeenSpheres&) = delete;

  const Scene& scene() const { return scene_; }

  /// The id here of a sphere, or kNothing if it is new.
  std::int64_t id_of(Address address) const;
  /// Where the sphere of an id here lies. rank -1: it only stands for others, or the id is no sphere's.
  Address address_of(std::int64_t id) const;
  std::int64_t whole_id_of(std::int64_t id) const { return whole_ids_[static_cast<std::size_t>(id)]; }
  /// Adds packed spheres that are new, which lie at these addresses.
  void add(const std::vector<Address>& addresses, ByteReader& packed);
  /// Forgets all that was seen.
  void forget();
  std::int64_t count() const { return scene_.spheres.size() - proxies_; }

 private:
  static std::uint64_t key_of(Address address) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(address.rank)) << 32 | address.place;
  }
  void append(ByteReader& packed);
  std::size_t slot_of(std::uint64_t key) const;
  void insert(std::uint64_t key, std::int64_t id);

  Scene scene_;
  SphereColumns has_;
  std::vector<std::int64_t> whole_ids_;
  std::int64_t proxies_ = 0;
  std::vector<Address> addresses_;  // of each sphere that was seen
  // A table with open addresses: ids by key.
  struct Slot {
    std::uint64_t key;
    std::int64_t id;
  };
  std::vector<Slot> slots_;
};

}  // namespace bihive
