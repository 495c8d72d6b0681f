#include "bihive/spread/ray_messages.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <limits>

namespace bihive {
namespace {

// Equal bits: -0 is not 0, and a NaN is itself.
template <class T>
bool all_alike(const std::vector<T>& values) {
  const auto* const bytes = reinterpret_cast<const unsigned char*>(values.data());
  const std::size_t all = values.size() * sizeof(T);
  return all <= sizeof(T) || std::memcmp(bytes, bytes + sizeof(T), all - sizeof(T)) == 0;
}

template <class T>
void put_column(const std::vector<T>& values, ByteWriter& out) {
  const bool alike = all_alike(values);
  out.put(static_cast<std::uint8_t>(alike ? 1 : 0));
  out.put_array(values.data(), alike ? std::min<std::size_t>(values.size(), 1) : values.size());
}

template <class T>
void take_column(ByteReader& in, std::size_t count, std::vector<T>& values) {
  values.resize(count);
  const bool alike = in.take<std::uint8_t>() != 0;
  in.take_array(values.data(), alike ? std::min<std::size_t>(count, 1) : count);
  if (alike && count > 0) std::fill(values.begin() + 1, values.end(), values.front());
}

// of(i) for each chosen ray.
template <class T, class Of>
void put_chosen_rays(const std::vector<std::int64_t>& chosen, const Of& of, ByteWriter& out) {
  static thread_local std::vector<T> values;
  values.clear();
  values.reserve(chosen.size());
  for (const std::int64_t i : chosen) values.push_back(of(i));
  put_column(values, out);
}

}  // namespace

Bytes rays_question(QuestionKind kind, WhichSpheres which, RayOrder order, const ChosenRays& rays) {
  Bytes bytes;
  ByteWriter out(bytes);
  out.put(kind);
  out.put(which);
  out.put(order);
  out.put(static_cast<std::int64_t>(rays.chosen->size()));
  const RaySpan& span = *rays.rays;
  const std::vector<std::int64_t>& chosen = *rays.chosen;
  for (const float* const* columns : {span.origin, span.direction})
    for (int axis = 0; axis < 3; ++axis)
      put_chosen_rays<float>(
          chosen, [&](std::int64_t i) { return columns[axis][i]; }, out);
  put_chosen_rays<double>(
      chosen, [&](std::int64_t i) { return span.t_min != nullptr ? span.t_min[i] : 0; }, out);
  put_chosen_rays<double>(
      chosen, [&](std::int64_t i) { return (*rays.ends)[static_cast<std::size_t>(i)]; }, out);
  put_column(*rays.places, out);
  put_column(*rays.ghosts, out);
  put_chosen_rays<std::uint8_t>(
      chosen, [&](std::int64_t i) { return span.inside != nullptr ? span.inside[i] : std::uint8_t{0}; }, out);
  return bytes;
}

void take_rays(ByteReader& in, RaysAsked& asked) {
  asked.which = in.take<WhichSpheres>();
  asked.order = in.take<RayOrder>();
  const auto count = static_cast<std::size_t>(in.take<std::int64_t>());
  RayBatch& rays = asked.rays;
  for (std::vector<float>* columns : {rays.origin, rays.direction})
    for (int axis = 0; axis < 3; ++axis) take_column(in, count, columns[axis]);
  take_column(in, count, rays.t_min);
  take_column(in, count, rays.t_max);
  static thread_local std::vector<Place> places;
  take_column(in, count, places);
  take_column(in, count, asked.ghosts);
  rays.leaves.resize(count);
  for (std::size_t i = 0; i < count; ++i)
    rays.leaves[i] = places[i] == kNoPlace ? kNothing : static_cast<std::int64_t>(places[i]);
  take_column(in, count, rays.inside);
}

void put_found(const std::vector<FoundSphere>& found, Bytes& answer) {
  ByteWriter out(answer);
  out.put(static_cast<std::int64_t>(found.size()));
  for (const FoundSphere& one : found) out.put(static_cast<std::uint32_t>(one.ray));
  for (const FoundSphere& one : found) out.put(one.t);
  for (const FoundSphere& one : found) out.put(one.whole_id);
  for (const FoundSphere& one : found) out.put(one.place);
}

std::vector<FoundSphere> take_found(const Bytes& answer) {
  ByteReader in(answer);
  std::vector<FoundSphere> found(static_cast<std::size_t>(in.take<std::int64_t>()));
  for (FoundSphere& one : found) one.ray = static_cast<std::int64_t>(in.take<std::uint32_t>());
  for (FoundSphere& one : found) one.t = in.take<double>();
  for (FoundSphere& one : found) one.whole_id = in.take<std::int64_t>();
  for (FoundSphere& one : found) one.place = in.take<Place>();
  return found;
}

void put_occluded(const std::vector<std::uint8_t>& is_occluded, Bytes& answer) {
  Bytes bits((is_occluded.size() + 7) / 8, 0);
  for (std::size_t i = 0; i < is_occluded.size(); ++i)
    if (is_occluded[i] != 0) bits[i / 8] = static_cast<char>(bits[i / 8] | (1 << (i % 8)));
  ByteWriter(answer).put_array(bits.data(), bits.size());
}

void take_occluded(const Bytes& answer, std::vector<std::uint8_t>& is_occluded) {
  for (std::size_t i = 0; i < is_occluded.size(); ++i)
    is_occluded[i] = static_cast<std::uint8_t>(static_cast<unsigned char>(answer[i / 8]) >> (i % 8) & 1);
}

}  // namespace bihive
