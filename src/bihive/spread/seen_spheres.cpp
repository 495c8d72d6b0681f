#include "bihive/spread/seen_spheres.h"

#include <cstddef>
#include <utility>

#include "bihive/geometry/ray.h"

namespace bihive {
namespace {

constexpr std::size_t kFirstSlots = 1024;

}  // namespace

SeenSpheres::SeenSpheres(Scene shell, const SphereColumns& has, const Bytes& proxies)
    : scene_(std::move(shell)), has_(has), slots_(kFirstSlots, {0, kNothing}) {
  ByteReader packed(proxies);
  while (!packed.at_end()) append(packed);
  proxies_ = scene_.spheres.size();
}

// Users know a sphere by its id in the whole set.
void SeenSpheres::append(ByteReader& packed) {
  append_spheres(packed, has_, scene_, whole_ids_);
  std::vector<std::int64_t>& known = scene_.id_in_input;
  if (!has_.input_id) known.insert(known.end(), whole_ids_.begin() + std::ptrdiff_t(known.size()), whole_ids_.end());
}

// The slot of the key, or the free one where it would be.
std::size_t SeenSpheres::slot_of(std::uint64_t key) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t at = static_cast<std::size_t>((key * 0x9E3779B97F4A7C15) >> 20) & mask;
  while (slots_[at].id != kNothing && slots_[at].key != key) at = (at + 1) & mask;
  return at;
}

void SeenSpheres::insert(std::uint64_t key, std::int64_t id) {
  slots_[slot_of(key)] = {key, id};
}

std::int64_t SeenSpheres::id_of(Address address) const {
  return slots_[slot_of(key_of(address))].id;
}

Address SeenSpheres::address_of(std::int64_t id) const {
  const std::int64_t number = id - proxies_;
  if (id < 0 || number < 0 || number >= static_cast<std::int64_t>(addresses_.size())) return {-1, kNoPlace};
  return addresses_[static_cast<std::size_t>(number)];
}

void SeenSpheres::add(const std::vector<Address>& addresses, ByteReader& packed) {
  const std::int64_t first = scene_.spheres.size();
  append(packed);
  addresses_.insert(addresses_.end(), addresses.begin(), addresses.end());
  std::size_t wanted = slots_.size();
  while (2 * addresses_.size() > wanted) wanted *= 2;
  if (wanted > slots_.size()) {
    std::vector<Slot> before(wanted, {0, kNothing});
    std::swap(before, slots_);
    for (const Slot& slot : before)
      if (slot.id != kNothing) insert(slot.key, slot.id);
  }
  for (std::size_t i = 0; i < addresses.size(); ++i) insert(key_of(addresses[i]), first + static_cast<std::int64_t>(i));
}

void SeenSpheres::forget() {
  keep_first_spheres(proxies_, has_, scene_, whole_ids_);
  if (!has_.input_id) scene_.id_in_input = whole_ids_;
  addresses_.clear();
  slots_.assign(kFirstSlots, {0, kNothing});
}

}  // namespace bihive
