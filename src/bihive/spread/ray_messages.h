// The bytes of questions about rays, and of their answers.
//
// A column of equal entries takes the space of one: the origin of primary rays, or absent ends.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/render/remote_engine.h"
#include "bihive/spread/bytes.h"

namespace bihive {

enum class QuestionKind : std::uint8_t { closest, occluded, all_hits, spheres };

/// The position of a sphere on its rank, as opposed to its id in the whole set; kNoPlace: none.
using Place = std::uint32_t;
constexpr Place kNoPlace = ~Place{0};

/// Some rays of a span: those of the numbers `chosen`. `places`: the positions, on the asked rank, of the spheres on
/// which the chosen rays start. `ghosts`: if it is another rank's sphere, and clips may let it matter, its id in the
/// whole set; else kNothing. `ends`: for all rays of the span; they replace t_max.
struct ChosenRays {
  const RaySpan* rays;
  const std::vector<std::int64_t>* chosen;
  const std::vector<Place>* places;
  const std::vector<std::int64_t>* ghosts;
  const std::vector<double>* ends;
};

Bytes rays_question(QuestionKind kind, WhichSpheres which, RayOrder order, const ChosenRays& rays);

/// The same on the receiving side. `rays.leaves` are positions, or kNothing.
struct RaysAsked {
  WhichSpheres which;
  RayOrder order;
  RayBatch rays;
  std::vector<std::int64_t> ghosts;
};
/// The kind was taken.
void take_rays(ByteReader& question, RaysAsked& asked);

/// One hit of one ray.
struct FoundSphere {
  std::int64_t ray;  ///< of the question
  double t;
  std::int64_t whole_id;
  Place place;
};
void put_found(const std::vector<FoundSphere>& found, Bytes& answer);
std::vector<FoundSphere> take_found(const Bytes& answer);

/// A bit for each ray.
void put_occluded(const std::vector<std::uint8_t>& is_occluded, Bytes& answer);
void take_occluded(const Bytes& answer, std::vector<std::uint8_t>& is_occluded);

}  // namespace bihive
