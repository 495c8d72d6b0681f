#include "bihive/scene/camera_path.h"

#include <cstddef>

namespace bihive {
namespace {

// A number at some pictures of the animation.
struct Knot {
  double picture, value;
};

double chord(const std::vector<Knot>& knots, std::size_t i) {
  return (knots[i + 1].value - knots[i].value) / (knots[i + 1].picture - knots[i].picture);
}

// The slope of the curve at a knot: that of a monotone cubic (Fritsch and Butland), so that it never overshoots; none
// at both ends.
double slope(const std::vector<Knot>& knots, std::size_t i) {
  if (i == 0 || i + 1 == knots.size()) return 0;
  const double before = chord(knots, i - 1), after = chord(knots, i);
  if (!(before * after > 0)) return 0;
  const double width_before = knots[i].picture - knots[i - 1].picture;
  const double width_after = knots[i + 1].picture - knots[i].picture;
  const double weight_before = width_before + 2 * width_after, weight_after = 2 * width_before + width_after;
  return (weight_before + weight_after) / (weight_before / before + weight_after / after);
}

// The curve through the knots; `otherwise` if there are none.
double curve_at(const std::vector<Knot>& knots, double picture, double otherwise) {
  if (knots.empty()) return otherwise;
  if (picture <= knots.front().picture) return knots.front().value;
  if (picture >= knots.back().picture) return knots.back().value;
  std::size_t i = 0;
  while (knots[i + 1].picture <= picture) ++i;
  // Hermite's form on the section from knot i to the next.
  const double width = knots[i + 1].picture - knots[i].picture;
  const double t = (picture - knots[i].picture) / width;
  const double rise = t * t * (3 - 2 * t);
  const double leave = t * (1 - t) * (1 - t) * width * slope(knots, i);
  const double arrive = t * t * (t - 1) * width * slope(knots, i + 1);
  return knots[i].value + rise * (knots[i + 1].value - knots[i].value) + leave + arrive;
}

// The curve of one number of the keys: `number_of` returns it where a key states it.
template <class NumberOf>
double track(const std::vector<CameraKey>& keys, std::int64_t picture, double otherwise, NumberOf number_of) {
  std::vector<Knot> knots;
  knots.reserve(keys.size());
  for (const CameraKey& key : keys)
    if (const std::optional<double> value = number_of(key)) knots.push_back({static_cast<double>(key.picture), *value});
  return curve_at(knots, static_cast<double>(picture), otherwise);
}

}  // namespace

Camera camera_at(const CameraPath& path, const Camera& base, std::int64_t picture, std::int64_t pictures) {
  if (!path.moves()) return base;
  Camera camera = base;

  // Move the look-at point.
  Vec3d look_at = base.look_at;
  for (int axis = 0; axis < 3; ++axis)
    look_at[axis] =
        track(path.keys, picture, base.look_at[axis], [axis](const CameraKey& key) -> std::optional<double> {
          return key.look_at ? std::optional<double>((*key.look_at)[axis]) : std::nullopt;
        });
  camera.eye = base.eye + (look_at - base.look_at);
  camera.look_at = look_at;

  // Turn and enlarge.
  const auto angle = [&](double Turn::*part) {
    return track(path.keys, picture, 0, [part](const CameraKey& key) -> std::optional<double> {
      return key.turn ? std::optional<double>((*key.turn).*part) : std::nullopt;
    });
  };
  const double share = static_cast<double>(picture) / static_cast<double>(pictures);
  const double turntable_deg = path.turntable_deg * share;
  if (path.axis && turntable_deg != 0) camera = turned_about(camera, *path.axis, turntable_deg);
  const Turn turn{angle(&Turn::azimuth) + (path.axis ? 0 : turntable_deg), angle(&Turn::elevation), angle(&Turn::roll)};
  camera = turned(camera, turn);
  return enlarged(camera, track(path.keys, picture, 1, [](const CameraKey& key) { return key.zoom; }));
}

}  // namespace bihive
