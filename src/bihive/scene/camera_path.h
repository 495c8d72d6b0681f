// A camera that moves during an animation: a turntable, or key frames with smooth transitions.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/scene/camera.h"
#include "bihive/scene/turn.h"

namespace bihive {

/// The camera at one picture of the animation. Unset values are interpolated between the keys before and after that
/// state them, and constant before the first and after the last of these.
struct CameraKey {
  std::int64_t picture = 0;      ///< from 0
  std::optional<Turn> turn;      ///< around look_at, from the animation's camera; may be above 360
  std::optional<double> zoom;    ///< magnification; above 0
  std::optional<Vec3d> look_at;  ///< the camera moves along with it
};

struct CameraPath {
  double turntable_deg = 0;     ///< rotation of the camera to the right around the scene, over the whole animation
  std::vector<CameraKey> keys;  ///< their pictures rise
  /// The turntable's axis through look_at, a unit vector in the world; unset: the picture's vertical.
  std::optional<Vec3d> axis{};

  bool moves() const { return turntable_deg != 0 || !keys.empty(); }
};

/// The camera of a picture, 0 to `pictures` - 1, of an animation whose camera is `base`. The turntable turns by equal
/// angles, and picture `pictures` would be at its end, so that 360 degrees loop seamlessly. Between two keys each
/// number follows a cubic curve that overshoots neither, and is at rest at its first and last key. The same bits on
/// every platform.
Camera camera_at(const CameraPath& path, const Camera& base, std::int64_t picture, std::int64_t pictures);

/// Key frames from JSON: {"keys": [{"picture": 0, "turn": [0, 0, 0], "zoom": 1, "look_at": [0, 0, 0]}, ...]}. Errors
/// name the location in the document and the expected value.
Result<std::vector<CameraKey>> parse_camera_keys(std::string_view json, const std::string& name);

/// The document of parse_camera_keys().
std::string camera_keys_to_json(const std::vector<CameraKey>& keys);

}  // namespace bihive
