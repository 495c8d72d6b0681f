// The spheres that options of the camera select.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "bihive/geometry/sphere_set.h"
#include "bihive/job/picture_request.h"
#include "bihive/scene/scene.h"

namespace bihive {

class CameraSelections {
 public:
  /// Those of no option.
  CameraSelections() = default;
  /// Evaluates the selections on the spheres as they were read, before looks hide some. Fails with kBadUsage on one
  /// that is wrong, or matches none: the message says what there is.
  CameraSelections(const PictureRequest& request, const SphereSet& spheres);

  /// The stored spheres in the scene, after looks and clips, that the setting with this id selects, in the order of
  /// their ids. Fails with kBadUsage where none is left.
  std::vector<std::int64_t> visible(const Scene& scene, const std::string& id) const;

 private:
  void add(const std::string& id, const std::string& selection, const SphereSet& spheres);

  std::map<std::string, std::vector<std::uint8_t>> masks_;
};

}  // namespace bihive
