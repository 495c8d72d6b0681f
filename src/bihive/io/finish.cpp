#include "bihive/io/finish.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "bihive/io/elements.h"

namespace bihive {
namespace {

constexpr double kDefaultRadius = 0.5;

// The user is told of a centre that moves by more than this share of its radius.
constexpr double kHarmlessShift = 0.01;

std::string to_text(double value) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << value;
  return text.str();
}

// "1 sphere has", "2 spheres have".
std::string spheres_have(std::int64_t count) {
  return std::to_string(count) + (count == 1 ? " sphere has" : " spheres have");
}

// Radii for a file without radii: by element, else the default.
void guess_radii(RawSpheres& raw, bool radius_given) {
  std::int64_t unknown = 0;
  raw.r.resize(raw.size());
  for (std::size_t i = 0; i < raw.size(); ++i) {
    const double known = raw.attributes.element.empty() ? 0 : van_der_waals_radius(raw.attributes.element[i]);
    raw.r[i] = known > 0 ? known : kDefaultRadius;
    unknown += known > 0 ? 0 : 1;
  }
  if (radius_given) return;
  const auto all = static_cast<std::int64_t>(raw.size());
  if (unknown < all) raw.rules.push_back("radii: van der Waals, by element");
  if (unknown > 0) {
    raw.rules.push_back("radii: 0.5 where neither element nor radius is known");
    raw.warnings.push_back((unknown == all ? "the spheres have" : spheres_have(unknown)) +
                           " neither element nor radius: the radius 0.5 is used; set it with --radius");
  }
}

Status apply_radius_options(RawSpheres& raw, const std::string& name, const ReadOptions& options) {
  if (raw.r.empty()) guess_radii(raw, options.radius.has_value());
  if (options.radius) {
    if (const char* fault = radius_fault(*options.radius))
      return Error{"the radius that replaces all others " + std::string(fault) + ": " + to_text(*options.radius), name,
                   0, 0, "give --radius a number from 0"};
    std::fill(raw.r.begin(), raw.r.end(), *options.radius);
    raw.rules.push_back("radii: all " + to_text(*options.radius) + ", as asked for");
  }
  if (options.radius_scale != 1) {
    if (const char* fault = radius_fault(options.radius_scale))
      return Error{"the factor for radii " + std::string(fault) + ": " + to_text(options.radius_scale), name, 0, 0,
                   "give --radius-scale a number from 0"};
    for (double& r : raw.r) r *= options.radius_scale;
    raw.rules.push_back("radii: multiplied by " + to_text(options.radius_scale));
  }
  return Done{};
}

// Moves the middle of the centres' bounding box to the origin, in binary64. Returns the vector that was subtracted.
Vec3d recenter(RawSpheres& raw) {
  const auto middle_of = [](const std::vector<double>& values) {
    const auto [lo, hi] = std::minmax_element(values.begin(), values.end());
    return 0.5 * *lo + 0.5 * *hi;
  };
  const Vec3d middle{middle_of(raw.x), middle_of(raw.y), middle_of(raw.z)};
  for (double& x : raw.x) x -= middle.x;
  for (double& y : raw.y) y -= middle.y;
  for (double& z : raw.z) z -= middle.z;
  raw.rules.push_back("recentred: (" + to_text(middle.x) + ", " + to_text(middle.y) + ", " + to_text(middle.z) +
                      ") subtracted from every centre");
  return middle;
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
  if (moved == 0) return;
  std::string text = "rounding to single precision moves " + std::to_string(moved) + " of " +
                     std::to_string(set.size()) + " centres by more than 1 % of the radius (sphere " +
                     std::to_string(worst) + " by " + to_text(100 * worst_share) + " %)";
  text += recentred ? "; the radii are too small for the extent" : "; --recenter makes it finer";
  warnings.push_back(text);
}

}  // namespace

Result<SphereFile> finish_spheres(RawSpheres raw, const std::string& name, const ReadOptions& options) {
  if (raw.size() == 0) return Error{"there are no spheres in it (read as " + raw.format + ")", name, 0, 0, ""};
  if (Status applied = apply_radius_options(raw, name, options); !applied) return applied.error();
  const Vec3d recentred_by = options.recenter ? recenter(raw) : Vec3d{};

  // Round once.
  Result<SphereSet> set = SphereSet::from_world(raw.x, raw.y, raw.z, raw.r);
  if (!set) {
    Error error = set.error();
    error.file = name;
    return error;
  }

  // Report the effects of rounding.
  warn_of_rounding(raw, *set, options.recenter, raw.warnings);
  if (const std::int64_t vanishing = set->vanishing_radii())
    raw.warnings.push_back(spheres_have(vanishing) +
                           " a radius below 2^-60 of the whole extent and cannot be told from a point");

  SphereFile file;
  file.spheres = std::move(*set);
  file.spheres.attributes() = std::move(raw.attributes);
  file.format = std::move(raw.format);
  file.frames = raw.frames;
  file.rules = std::move(raw.rules);
  file.warnings = std::move(raw.warnings);
  file.recentred_by = recentred_by;
  return file;
}

}  // namespace bihive
