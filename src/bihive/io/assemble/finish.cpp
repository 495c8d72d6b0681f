#include "bihive/io/assemble/finish.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "bihive/base/memory.h"
#include "bihive/base/readable.h"
#include "bihive/io/assemble/unit_cell.h"
#include "bihive/io/assemble/unknown_radii.h"
#include "bihive/io/assemble/wrapping.h"

namespace bihive {
namespace {

// The user is told of a centre that moves by more than this share of its radius.
constexpr double kHarmlessShift = 0.01;

// Three coordinates and a radius as they are read, and as they are kept.
constexpr double kRadiusBytes = sizeof(double), kReadBytes = 4 * sizeof(double), kSetBytes = 4 * sizeof(float);

// Such a set takes 3 MB. Its tree decides whether it fits.
constexpr std::int64_t kSmallSet = 1 << 16;

Status apply_radius_options(RawSpheres& raw, const std::string& name, const ReadOptions& options) {
  if (options.radius) {
    if (const char* fault = radius_fault(*options.radius))
      return Error{
          "the radius that replaces all others " + std::string(fault) + ": " + readable_number(*options.radius), name,
          0, 0, "give --radius a number from 0"};
    raw.r.assign(raw.size(), *options.radius);
    raw.rules.push_back("radii: all " + readable_number(*options.radius) + ", as asked for");
  } else if (greatest_of_all(options.parts.get(), raw.r.empty() ? 0 : 1) == 0) {
    // No part has radii; one without spheres cannot tell.
    fill_radii(raw, options.parts.get());
  }
  if (options.radius_scale != 1) {
    if (const char* fault = radius_fault(options.radius_scale))
      return Error{"the factor for radii " + std::string(fault) + ": " + readable_number(options.radius_scale), name, 0,
                   0, "give --radius-scale a number from 0"};
    for (double& r : raw.r) r *= options.radius_scale;
    raw.rules.push_back("radii: multiplied by " + readable_number(options.radius_scale));
  }
  return Done{};
}

// Moves the middle of the centres' bounding box to the origin, in binary64; copies count. Returns the vector that was
// subtracted.
Vec3d recenter(RawSpheres& raw, const Images& images, const SetParts* parts) {
  const Images::Shifts shifts = images.shifts();
  const auto middle_of = [&](const std::vector<double>& values, int axis) {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    std::vector<double> ends{-kInfinite, -kInfinite};
    for (const double value : values) ends = {std::max(ends[0], -value), std::max(ends[1], value)};
    greatest_of_all(parts, ends);
    return 0.5 * (-ends[0] + shifts.lo[axis]) + 0.5 * (ends[1] + shifts.hi[axis]);
  };
  const Vec3d middle{middle_of(raw.x, 0), middle_of(raw.y, 1), middle_of(raw.z, 2)};
  if (raw.cell) raw.cell->origin = raw.cell->origin - middle;
  for (double& x : raw.x) x -= middle.x;
  for (double& y : raw.y) y -= middle.y;
  for (double& z : raw.z) z -= middle.z;
  raw.rules.push_back("recentred: (" + readable_number(middle.x) + ", " + readable_number(middle.y) + ", " +
                      readable_number(middle.z) + ") subtracted from every centre");
  return middle;
}

// The cell as the user wants it, the centres moved by it, and the copies that are wanted along it.
Result<Images> apply_cell_options(RawSpheres& raw, const std::string& name, const ReadOptions& options) {
  if (options.cell_vectors) {
    raw.cell = Cell{raw.cell ? raw.cell->origin : Vec3d{}, *options.cell_vectors};
    raw.rules.push_back("cell: its vectors as asked for");
  }
  if (options.cell_origin) {
    if (!raw.cell)
      return Error{"there is no periodic cell that could begin elsewhere", name, 0, 0, "give one with --cell-vectors"};
    raw.cell->origin = *options.cell_origin;
  }
  if (raw.cell && !is_finite(*raw.cell)) return Error{"the numbers of the cell must be finite", name, 0, 0, ""};
  if (Status status = apply_wrapping(raw, options.wrapping, name); !status) return status.error();
  Images images;
  if (options.replicate == images.counts) return images;
  if (!raw.cell) return Error{"there is no periodic cell to replicate by", name, 0, 0, "give one with --cell-vectors"};
  images.counts = options.replicate;
  images.vectors = raw.cell->vectors;
  raw.rules.push_back("replicated: " + std::to_string(images.counts[0]) + " x " + std::to_string(images.counts[1]) +
                      " x " + std::to_string(images.counts[2]) + " copies along the cell's vectors");
  return images;
}

// Warns of centres that single precision moves too far.
void warn_of_rounding(const RawSpheres& raw, const SphereSet& set, bool recentred, std::vector<std::string>& warnings) {
  std::int64_t moved = 0, worst = -1;
  double worst_share = kHarmlessShift;
  for (std::int64_t id = 0; id < set.size(); ++id) {
    const auto i = static_cast<std::size_t>(id);
    if (!(raw.r[i] > 0)) continue;
    const double share = length(set.centre(id) - Vec3d{raw.x[i], raw.y[i], raw.z[i]}) / raw.r[i];
    if (!(share > kHarmlessShift)) continue;
    ++moved;
    if (share > worst_share) {
      worst_share = share;
      worst = id;
    }
  }
  // The worst of all parts, the first of equal ones.
  if (set.parts() != nullptr) {
    const std::int64_t first = count_of_all(set.parts(), set.size()).before;
    moved = count_of_all(set.parts(), moved).all;
    const std::vector<double> own{worst_share, static_cast<double>(first + worst)};
    worst_share = kHarmlessShift;
    for (const std::vector<double>& one : set.parts()->gather(own)) {
      if (!(one[0] > worst_share)) continue;
      worst_share = one[0];
      worst = static_cast<std::int64_t>(one[1]);
    }
  }
  if (moved == 0) return;
  std::string text = "rounding to single precision moves " + std::to_string(moved) + " of " +
                     std::to_string(set.whole_size()) + " centres by more than 1 % of the radius (sphere " +
                     std::to_string(worst) + " by " + readable_number(100 * worst_share) + " %)";
  text += recentred ? "; the radii are too small for the extent" : "; --recenter makes it finer";
  warnings.push_back(text);
}

}  // namespace

Result<SphereFile> finish_spheres(RawSpheres raw, const std::string& name, const ReadOptions& options) {
  const SetParts* const parts = options.parts.get();
  if (count_of_all(parts, static_cast<std::int64_t>(raw.size())).all == 0)
    return Error{"there are no spheres in it (read as " + raw.format + ")", name, 0, 0, ""};
  const auto count = static_cast<std::int64_t>(raw.size());
  if (count > kSmallSet)
    if (Status status =
            check_memory(static_cast<double>(count) * (raw.r.empty() ? kRadiusBytes + kSetBytes : kSetBytes),
                         "a set of " + grouped(count) + " spheres",
                         static_cast<double>(count) * (raw.r.empty() ? kReadBytes - kRadiusBytes : kReadBytes));
        !status)
      return Error{status.error().message, name, 0, 0, ""};
  if (Status applied = apply_radius_options(raw, name, options); !applied) return applied.error();
  const Result<Images> images = apply_cell_options(raw, name, options);
  if (!images) return images.error();
  const Vec3d recentred_by = options.recenter ? recenter(raw, *images, parts) : Vec3d{};

  // Round once.
  Result<SphereSet> set = parts == nullptr ? SphereSet::from_world(raw.x, raw.y, raw.z, raw.r)
                                           : SphereSet::part_from_world(raw.x, raw.y, raw.z, raw.r, options.parts);
  if (!set) {
    Error error = set.error();
    error.file = name;
    return error;
  }

  // Report the effects of rounding.
  warn_of_rounding(raw, *set, options.recenter, raw.warnings);
  set->cell() = raw.cell;
  if (Status status = set->replicate(images->vectors, images->counts); !status) {
    Error error = status.error();
    error.file = name;
    error.hint = "see --replicate and --cell-vectors";
    return error;
  }
  if (const std::int64_t vanishing = count_of_all(parts, set->vanishing_radii()).all)
    raw.warnings.push_back(spheres_have(vanishing) +
                           " a radius below 2^-60 of the whole extent and cannot be told from a point");

  SphereFile file;
  file.spheres = std::move(*set);
  file.spheres.attributes() = std::move(raw.attributes);
  file.format = std::move(raw.format);
  file.frames = raw.frames;
  file.time_ps = raw.time_ps;
  file.step = raw.step;
  file.assemblies = raw.assemblies.ids();
  file.rules = std::move(raw.rules);
  file.warnings = std::move(raw.warnings);
  file.recentred_by = recentred_by;
  return file;
}

}  // namespace bihive
