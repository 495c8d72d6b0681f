#include "bihive/measure/union_measures.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "bihive/base/setting_name.h"
#include "bihive/base/watch.h"
#include "bihive/measure/balls.h"
#include "bihive/measure/boundary.h"
#include "bihive/measure/lattice_union_find.h"
#include "bihive/measure/periodic_balls.h"
#include "bihive/measure/surfaces.h"
#include "bihive/measure/union_find.h"

namespace bihive {
namespace {

using measure::Balls;
using measure::Boundary;
using measure::Counted;
using measure::counted_spheres;
using measure::ExposedPart;

// A sum with the error of few additions, in the order of the calls [Neumaier1974].
class AccurateSum {
 public:
  void add(double x) {
    const double sum = sum_ + x;
    lost_ += std::abs(sum_) >= std::abs(x) ? (sum_ - sum) + x : (x - sum) + sum_;
    sum_ = sum;
  }
  double value() const { return sum_ + lost_; }

 private:
  double sum_ = 0, lost_ = 0;
};

Status check_options(const SphereSet& set, const MeasureOptions& options) {
  if (set.has_images())
    return Error{"measures are those of the stored spheres, and this set has copies along a cell", "", 0, 0, ""};
  if (!std::isfinite(options.probe) || options.probe < 0)
    return Error{setting_name("probe") + " must be a finite number of at least 0", "", 0, 0, ""};
  if (options.probe * set.scale() >= 0x1p40)
    return Error{setting_name("probe") + " must be below 10^12 times the extent of the spheres", "", 0, 0, ""};
  if (options.periodic && !Lattice::of(set.cell())) {
    const std::string why = set.cell() ? Lattice::why_none(*set.cell()) : "";
    return Error{why.empty() ? "there is no periodic cell along which the spheres repeat" : why, "", 0, 0, ""};
  }
  return Done{};
}

// Sums over all balls, in the order of ids.
UnionMeasures measured(const Counted& counted, const Boundary& boundary, const SphereSet& set, bool by_cells) {
  UnionMeasures measures;
  measures.sphere_area.assign(static_cast<std::size_t>(set.size()), 0.0);
  const double unit = set.inverse_scale();
  const Balls& balls = counted.balls;
  AccurateSum area, volume;
  double area_error = 0, volume_error = 0;
  for (std::int64_t i = 0; i < counted.size(); ++i) {
    const ExposedPart& part = boundary.parts[i];
    const double r = balls.radius[i];
    const double own = r * r * part.solid_angle;
    area.add(own);
    measures.sphere_area[counted.ids[i]] = own * unit * unit;
    area_error += r * r * (part.solid_angle_error + 0x1p-51 * part.solid_angle);
    if (by_cells) {
      volume.add(r * r * r * boundary.cells[i].volume);
      volume_error += r * r * r * boundary.cells[i].volume_error;
      continue;
    }
    volume.add((r * own + r * r * dot(balls.centre[i], part.outwards)) / 3);
    const double c = length(balls.centre[i]);
    volume_error += r * r *
                    (r * (part.solid_angle_error + 0x1p-50 * part.solid_angle) +
                     c * (part.outwards_error + 0x1p-50 * part.solid_angle)) /
                    3;
  }
  measures.area = area.value() * unit * unit;
  measures.volume = std::max(volume.value(), 0.0) * unit * unit * unit;
  measures.area_error = area_error * unit * unit;
  measures.volume_error = volume_error * unit * unit * unit;
  return measures;
}

void add_sphere_volumes(const Counted& counted, const Boundary& boundary, const SphereSet& set,
                        UnionMeasures& measures) {
  measures.sphere_volume.assign(static_cast<std::size_t>(set.size()), 0.0);
  for (std::int64_t i = 0; i < counted.size(); ++i) {
    const double r = counted.balls.radius[i] * set.inverse_scale();
    measures.sphere_volume[counted.ids[i]] = r * r * r * boundary.cells[i].volume;
  }
}

// In the order of chunks and ids.
void add_derivatives(const Counted& counted, const Boundary& boundary, const SphereSet& set, UnionMeasures& measures) {
  measures.derivatives.assign(static_cast<std::size_t>(set.size()), {});
  const double unit = set.inverse_scale();
  for (const std::vector<measure::AreaChange>& chunk : boundary.changes)
    for (const measure::AreaChange& change : chunk) {
      MeasureDerivatives& own = measures.derivatives[counted.ids[change.ball]];
      own.area_by_centre = own.area_by_centre + unit * change.by_centre;
      own.area_by_radius += unit * change.by_radius;
    }
  for (std::int64_t i = 0; i < counted.size(); ++i) {
    MeasureDerivatives& own = measures.derivatives[counted.ids[i]];
    const double r = counted.balls.radius[i] * unit;
    own.volume_by_centre = (r * r) * boundary.parts[i].outwards;
    own.volume_by_radius = (r * r) * boundary.parts[i].solid_angle;
  }
}

void add_contacts(const Counted& counted, const Boundary& boundary, const SphereSet& set, UnionMeasures& measures) {
  const Balls& balls = counted.balls;
  for (const std::vector<measure::OwnedFacet>& chunk : boundary.facets)
    for (const auto& [ball, facet] : chunk) {
      const double r = balls.radius[ball] * set.inverse_scale();
      Contact contact{counted.ids[ball], 0, {}, r * r * facet.area, r * facet.distance, r * r * facet.area_error};
      std::int64_t other = facet.ball;
      if (balls.is_periodic()) {
        // Relative to where the spheres are stored.
        other = balls.image[facet.ball].ball;
        contact.image = balls.image[facet.ball].counts() + counted.moved[other] - counted.moved[ball];
      }
      contact.second = counted.ids[other];
      measures.contacts.push_back(contact);
    }
  std::sort(measures.contacts.begin(), measures.contacts.end(), [](const Contact& a, const Contact& b) {
    return std::tie(a.first, a.second, a.image) < std::tie(b.first, b.second, b.image);
  });
}

void add_porosity(const SphereSet& set, UnionMeasures& measures) {
  const Cell& cell = *set.cell();
  for (std::size_t k = 0; k < 3; ++k)
    if (!cell.periodic[k] || cell.vectors[k] == Vec3d{}) return;
  const Vec3d &a = cell.vectors[0], &b = cell.vectors[1], &c = cell.vectors[2];
  measures.cell_volume = std::abs(dot(a, cross(b, c)));
  // Products of the lengths are at most 256 times the volume (Lattice::of()).
  const double cell_error = 0x1p-50 * length(a) * length(b) * length(c);
  measures.volume = std::min(measures.volume, measures.cell_volume);
  measures.porosity = 1 - measures.volume / measures.cell_volume;
  measures.porosity_error = (measures.volume_error + cell_error) / measures.cell_volume;
}

std::vector<std::int64_t> ids_of(const Counted& counted, const std::vector<std::int64_t>& balls) {
  std::vector<std::int64_t> ids;
  for (const std::int64_t ball : balls) ids.push_back(counted.ids[ball]);
  return ids;
}

// The connected parts of a periodic union, by the balls that share points.
std::int64_t periodic_components(const Counted& counted, const Boundary& boundary) {
  measure::UnionFind<std::int64_t> groups(counted.size());
  for (const std::vector<measure::Link>& chunk : boundary.links)
    for (const measure::Link& link : chunk) groups.join(link.i, counted.balls.image[link.j].ball);
  return groups.groups();
}

void add_surfaces(const Counted& counted, const std::optional<Lattice>& lattice, Boundary boundary,
                  const SphereSet& set, UnionMeasures& measures) {
  const double unit = set.inverse_scale();
  for (const measure::Pieces& list : boundary.pieces) measures.undecided_spheres += list.undecided_spheres;
  if (lattice) measures.components = periodic_components(counted, boundary);
  for (measure::Surface& surface : measure::surfaces_of(counted.balls, lattice, std::move(boundary.pieces))) {
    const double area = surface.area * unit * unit;
    if (!surface.translations.empty()) {
      measures.channels.push_back({area, surface.translations, ids_of(counted, surface.balls)});
      continue;
    }
    if (surface.encloses_balls) {
      measures.components += lattice ? 0 : 1;
      continue;
    }
    const double volume = -surface.volume * unit * unit * unit;
    if (volume > measures.volume_error) measures.cavities.push_back({volume, area, ids_of(counted, surface.balls)});
  }
  std::stable_sort(measures.cavities.begin(), measures.cavities.end(),
                   [](const Cavity& a, const Cavity& b) { return a.volume > b.volume; });
  std::stable_sort(measures.channels.begin(), measures.channels.end(),
                   [](const PercolatingSurface& a, const PercolatingSurface& b) { return a.area > b.area; });
}

}  // namespace

Result<UnionMeasures> measure_union(const SphereSet& set, const MeasureOptions& options) {
  if (const Status status = check_options(set, options); !status) return status.error();
  try {
    WatchedWork work;
    Counted counted = counted_spheres(set, options.probe * set.scale(), options.mask);
    std::optional<Lattice> lattice;
    if (options.periodic) {
      lattice = Lattice::of(set.cell())->times(set.scale());
      Result<std::vector<ImageCounts>> moved = measure::add_images(counted.balls, *lattice);
      if (!moved) return moved.error();
      counted.moved = std::move(*moved);
    }
    // A periodic union goes on beyond the cell, where the divergence theorem would need its cut: cells sum up there.
    measure::Wanted wanted;
    wanted.cells = options.sphere_volumes || options.periodic;
    wanted.facets = options.contacts;
    wanted.pieces = options.cavities;
    wanted.changes = options.derivatives;
    Result<Boundary> boundary = measure::boundary_of(counted, set, wanted, options.threads);
    if (!boundary) return boundary.error();
    work.stop_if_cancelled();
    UnionMeasures measures = measured(counted, *boundary, set, options.periodic);
    if (options.sphere_volumes) add_sphere_volumes(counted, *boundary, set, measures);
    if (options.derivatives) add_derivatives(counted, *boundary, set, measures);
    if (options.contacts) add_contacts(counted, *boundary, set, measures);
    if (options.periodic) add_porosity(set, measures);
    if (options.cavities) add_surfaces(counted, lattice, std::move(*boundary), set, measures);
    return measures;
  } catch (const Cancelled&) {
    return cancelled_error();
  } catch (const std::bad_alloc&) {
    return Error{"not enough memory to measure " + std::to_string(set.size()) + " spheres", "", 0, 0, ""};
  }
}

}  // namespace bihive
