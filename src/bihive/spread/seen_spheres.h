// A drawing thread's cache of other ranks' spheres: those that its rays have met.
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

/// The scene's spheres are the proxies (spread/proxies.h), then those that were seen, in order of arrival. Their ids
/// are valid in this scene alone.
class SeenSpheres {
 public:
  /// `shell`: the scene without spheres.
  SeenSpheres(Scene shell, const SphereColumns& has, const Bytes& proxies);
  SeenSpheres(const SeenSpheres&) = delete;
  SeenSpheres& operator=(const SeenSpheres&) = delete;

  const Scene& scene() const { return scene_; }

  /// The local id of a sphere, or kNothing if it is new.
  std::int64_t id_of(Address address) const;
  /// The address of the sphere with a local id. rank -1: a proxy, or not a sphere.
  Address address_of(std::int64_t id) const;
  std::int64_t whole_id_of(std::int64_t id) const { return whole_ids_[static_cast<std::size_t>(id)]; }
  /// Adds new packed spheres, with their addresses.
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
  // A hash table with open addressing: ids by key.
  struct Slot {
    std::uint64_t key;
    std::int64_t id;
  };
  std::vector<Slot> slots_;
};

}  // namespace bihive
