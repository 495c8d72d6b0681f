#include "bihive/io/assemble/finish.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "bihive/base/memory.h"
#include "bihive/base/readable.h"
#include "bihive/base/setting_name.h"
#include "bihive/base/watch.h"
#include "bihive/geometry/lattice.h"
#include "bihive/io/assemble/exposed_area.h"
#include "bihive/io/assemble/unit_cell.h"
#include "bihive/io/assemble/unknown_radii.h"
#include "bihive/io/assemble/wrapping.h"

namespace bihive {
namespace {

// Three coordinates and a radius as they are read, and as they are kept.
constexpr double kRadiusBytes = sizeof(double), kReadBytes = 4 * sizeof(double), kSetBytes = 4 * sizeof(float);

// The first frame's origin fits another one as long as its extent about it is at most so large.
constexpr double kMostOfOwnExtent = 4;

// Such a set takes 3 MB. Its tree decides whether it fits.
constexpr std::int64_t kSmallSet = 1 << 16;

Status apply_radius_options(RawSpheres& raw, const std::string& name, const ReadOptions& options) {
  if (options.radius) {
    if (const char* fault = radius_fault(*options.radius))
      return Error{
          "the radius that replaces all others " + std::string(fault) + ": " + readable_number(*options.radius), name,
          0, 0, "give " + setting_name("radius") + " a number from 0"};
    raw.r.assign(raw.size(), *options.radius);
    raw.rules.push_back("radii: all " + readable_number(*options.radius) + ", as asked for");
  }
  if (options.radius_scale != 1) {
    if (const char* fault = radius_fault(options.radius_scale))
      return Error{"the factor for radii " + std::string(fault) + ": " + readable_number(options.radius_scale), name, 0,
                   0, "give " + setting_name("radius_scale") + " a number from 0"};
    for (double& r : raw.r) r *= options.radius_scale;
    raw.rules.push_back("radii: multiplied by " + readable_number(options.radius_scale));
  }
  return Done{};
}

// The cell as the user wants it, the centres moved by it, and the copies that are wanted along it.
Result<Images> apply_cell_options(RawSpheres& raw, const std::string& name, const ReadOptions& options) {
  raw.cell = cell_by_options(raw.cell, options);
  if (options.cell_vectors) raw.rules.push_back("cell: its vectors as asked for");
  if (options.cell_vectors)
    if (const std::string why = Lattice::why_none(*raw.cell); !why.empty()) raw.warnings.push_back(name + ": " + why);
  if (options.cell_origin && !raw.cell)
    return Error{"there is no periodic cell that could begin elsewhere", name, 0, 0,
                 "give one with " + setting_name("cell_vectors")};
  if (raw.cell && !is_finite(*raw.cell)) return Error{"the numbers of the cell must be finite", name, 0, 0, ""};
  if (Status status = apply_wrapping(raw, options.wrapping, name); !status) return status.error();
  Images images;
  if (options.replicate == images.counts) return images;
  if (!raw.cell)
    return Error{"there is no periodic cell to replicate by", name, 0, 0,
                 "give one with " + setting_name("cell_vectors")};
  images.counts = options.replicate;
  images.vectors = raw.cell->vectors;
  raw.rules.push_back("replicated: " + std::to_string(images.counts[0]) + " x " + std::to_string(images.counts[1]) +
                      " x " + std::to_string(images.counts[2]) + " copies along the cell's vectors");
  return images;
}

}  // namespace

SphereFinisher::SphereFinisher(RawSpheres raw, std::string name, const ReadOptions& options)
    : raw_(std::move(raw)), name_(std::move(name)), options_(options) {}

Error SphereFinisher::named(Error error) const {
  error.file = name_;
  return error;
}

std::optional<Cell> SphereFinisher::cell() const {
  return cell_by_options(raw_.cell, options_);
}

Status SphereFinisher::begin(std::int64_t first, std::int64_t all) {
  first_ = first;
  all_ = all;
  if (all == 0) return Error{"there are no spheres in it (read as " + raw_.format + ")", name_, 0, 0, ""};
  const auto count = static_cast<std::int64_t>(raw_.size());
  if (count > kSmallSet)
    if (Status status =
            check_memory(static_cast<double>(count) * (raw_.r.empty() ? kRadiusBytes + kSetBytes : kSetBytes),
                         "a set of " + grouped(count) + " spheres",
                         static_cast<double>(count) * (raw_.r.empty() ? kReadBytes - kRadiusBytes : kReadBytes));
        !status)
      return Error{status.error().message, name_, 0, 0, ""};
  return Done{};
}

Status SphereFinisher::apply_options() {
  if (Status applied = apply_radius_options(raw_, name_, options_); !applied) return applied;
  const Result<Images> images = apply_cell_options(raw_, name_, options_);
  if (!images) return images.error();
  images_ = *images;
  return Done{};
}

std::array<double, 6> SphereFinisher::centre_ends() const {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  std::array<double, 6> ends{};
  std::size_t at = 0;
  for (const std::vector<double>* const values : {&raw_.x, &raw_.y, &raw_.z}) {
    double low = -kInfinite, high = -kInfinite;
    for (const double value : *values) {
      low = std::max(low, -value);
      high = std::max(high, value);
    }
    ends[at++] = low;
    ends[at++] = high;
  }
  return ends;
}

// Moves the middle of the centres' bounding box to the origin, in binary64; copies count.
void SphereFinisher::recenter(const std::array<double, 6>& ends) {
  const Images::Shifts shifts = images_.shifts();
  const auto middle_of = [&](std::size_t axis) {
    return 0.5 * (-ends[2 * axis] + shifts.lo[static_cast<int>(axis)]) +
           0.5 * (ends[2 * axis + 1] + shifts.hi[static_cast<int>(axis)]);
  };
  const Vec3d middle{middle_of(0), middle_of(1), middle_of(2)};
  if (raw_.cell) raw_.cell->origin = raw_.cell->origin - middle;
  for (double& x : raw_.x) x -= middle.x;
  for (double& y : raw_.y) y -= middle.y;
  for (double& z : raw_.z) z -= middle.z;
  raw_.rules.push_back("recentred: (" + readable_number(middle.x) + ", " + readable_number(middle.y) + ", " +
                       readable_number(middle.z) + ") subtracted from every centre");
  recentred_by_ = middle;
}

Result<WorldEnds> SphereFinisher::ends() const {
  Result<WorldEnds> ends = SphereSet::ends_of_world(raw_.x, raw_.y, raw_.z, raw_.r, first_);
  if (!ends) return named(ends.error());
  return ends;
}

bool SphereFinisher::is_coarse_about_zero(const WorldEnds& ends_of_whole) const {
  return SphereSet::is_coarse_about_zero(raw_.x, raw_.y, raw_.z, raw_.r, ends_of_whole);
}

Result<RoundingLoss> SphereFinisher::round(const WorldEnds& ends_of_whole, Vec3d origin) {
  Result<SphereSet> set = SphereSet::chunk_from_world(raw_.x, raw_.y, raw_.z, raw_.r, ends_of_whole, origin);
  if (!set) return named(set.error());
  set_ = std::move(*set);
  const RoundingLoss loss = rounding_loss(set_, NumbersView::of(raw_.x), NumbersView::of(raw_.y),
                                          NumbersView::of(raw_.z), NumbersView::of(raw_.r), first_);
  if (set_.has_origin())
    raw_.rules.push_back(fmt::format("coordinates: rounded relative to ({}, {}, {}), where single precision is finer",
                                     origin.x, origin.y, origin.z));

  set_.cell() = raw_.cell;
  if (Status status = add_exposed_area(set_, options_, raw_.attributes); !status) return named(status.error());
  if (Status status = set_.replicate(images_.vectors, images_.counts); !status) {
    Error error = named(status.error());
    error.hint = "see " + setting_name("replicate") + " and " + setting_name("cell_vectors");
    return error;
  }
  return loss;
}

SphereFile SphereFinisher::finish(const RoundingLoss& of_whole) {
  if (std::string warning = rounding_warning(of_whole, all_); !warning.empty())
    raw_.warnings.push_back(std::move(warning));
  if (of_whole.vanishing > 0)
    raw_.warnings.push_back(spheres_have(of_whole.vanishing) +
                            " a radius below 2^-60 of the whole extent and cannot be told from a point");
  SphereFile file;
  file.spheres = std::move(set_);
  file.spheres.attributes() = std::move(raw_.attributes);
  file.format = std::move(raw_.format);
  file.title = std::move(raw_.title);
  file.entry_id = std::move(raw_.entry_id);
  file.frames = raw_.frames;
  file.time_ps = raw_.time_ps;
  file.step = raw_.step;
  file.assemblies = raw_.assemblies.ids();
  file.rules = std::move(raw_.rules);
  file.warnings = std::move(raw_.warnings);
  file.assumed_radii = raw_.assumed_radii && options_.radius_scale == 1;
  file.recentred_by = recentred_by_;
  return file;
}

Result<SphereFile> finish_spheres(RawSpheres raw, const std::string& name, const ReadOptions& options,
                                  bool may_be_empty, const std::function<Vec3d()>& origin_of_first_frame) {
  SphereFinisher steps(std::move(raw), name, options);
  const auto count = static_cast<std::int64_t>(steps.raw().size());
  const bool is_empty = count == 0 && may_be_empty;
  if (Status status = is_empty ? Status(Done{}) : steps.begin(0, count); !status) return status.error();
  stop_if_cancelled();
  if (!steps.has_radii()) {
    const std::int64_t unknown = count_unknown_radii(steps.raw());
    const bool guesses = unknown > 0 && !steps.raw().unknown_radius;
    steps.fill_radii({unknown, count, guesses ? radius_from_neighbours(steps.raw(), steps.cell()) : std::nullopt});
  }
  stop_if_cancelled();
  if (Status status = steps.apply_options(); !status) return status.error();
  stop_if_cancelled();
  if (options.recenter && !is_empty) steps.recenter(steps.centre_ends());
  const Result<WorldEnds> ends = steps.ends();
  if (!ends) return ends.error();
  Vec3d origin;
  if (steps.is_coarse_about_zero(*ends)) {
    origin = ends->origin();
    const Vec3d first = origin_of_first_frame ? origin_of_first_frame() : Vec3d{};
    if (first != Vec3d{} && ends->extent(first) <= kMostOfOwnExtent * ends->extent(origin)) origin = first;
  }
  stop_if_cancelled();
  const Result<RoundingLoss> loss = steps.round(*ends, origin);
  if (!loss) return loss.error();
  return steps.finish(*loss);
}

}  // namespace bihive
