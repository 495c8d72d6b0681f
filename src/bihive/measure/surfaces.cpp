#include "bihive/measure/surfaces.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <tuple>

#include "bihive/measure/lattice_union_find.h"

namespace bihive::measure {
std::vector<Surface> surfaces_of(const Balls& balls, const std::optional<Lattice>& lattice, std::vector<Pieces> lists,
                                 std::vector<std::int64_t>* surface_of_piece) {
  // Number all pieces.
  Pieces all;
  for (Pieces& list : lists) {
    const auto first = static_cast<std::int64_t>(all.pieces.size());
    for (Junction& junction : list.junctions) junction.piece += first;
    all.pieces.insert(all.pieces.end(), list.pieces.begin(), list.pieces.end());
    all.owner.insert(all.owner.end(), list.owner.begin(), list.owner.end());
    all.junctions.insert(all.junctions.end(), list.junctions.begin(), list.junctions.end());
    list = {};
  }

  // Join those that meet in a junction.
  std::sort(all.junctions.begin(), all.junctions.end());
  LatticeUnionFind groups(static_cast<std::int64_t>(all.pieces.size()));
  const auto place_of = [](const Junction& j) { return std::tie(j.i, j.j, j.k, j.side); };
  for (std::size_t n = 1; n < all.junctions.size(); ++n) {
    const Junction &last = all.junctions[n - 1], &here = all.junctions[n];
    if (place_of(here) == place_of(last))
      groups.join(last.piece, {last.lift[0], last.lift[1], last.lift[2]}, here.piece,
                  {here.lift[0], here.lift[1], here.lift[2]});
  }
  const std::map<std::int64_t, Translations> loops = groups.loops();

  // Sum up each surface, relative to the centre of its first ball.
  std::vector<Surface> surfaces;
  std::vector<std::int64_t> surface_of_group(all.pieces.size(), -1);
  std::vector<ImageCounts> first_image;  // of each surface's first piece
  for (std::size_t p = 0; p < all.pieces.size(); ++p) {
    const LatticeUnionFind::Member member = groups.member(static_cast<std::int64_t>(p));
    std::int64_t& at = surface_of_group[member.group];
    const std::int64_t ball = all.owner[p];
    if (at < 0) {
      at = static_cast<std::int64_t>(surfaces.size());
      surfaces.emplace_back();
      first_image.push_back(member.image);
      if (const auto loop = loops.find(member.group); loop != loops.end())
        surfaces.back().translations = loop->second.rows();
    }
    if (surface_of_piece != nullptr) surface_of_piece->push_back(at);
    Surface& surface = surfaces[at];
    surface.balls.push_back(ball);
    const double r = balls.radius[ball];
    Vec3d offset = balls.centre[ball] - balls.centre[surface.balls.front()];
    if (lattice) offset = offset + lattice->shift(member.image - first_image[at]);
    surface.area += r * r * all.pieces[p].solid_angle;
    surface.volume += r * r * (r * all.pieces[p].solid_angle + dot(offset, all.pieces[p].outwards)) / 3;
  }
  for (Surface& surface : surfaces) {
    // An outer one encloses its balls, a cavity none.
    const double r = balls.radius[surface.balls.front()];
    if (!surface.translations.empty()) surface.volume = 0;
    surface.encloses_balls = surface.volume > std::numbers::pi * r * r * r;
    std::sort(surface.balls.begin(), surface.balls.end());
    surface.balls.erase(std::unique(surface.balls.begin(), surface.balls.end()), surface.balls.end());
  }
  return surfaces;
}

}  // namespace bihive::measure
