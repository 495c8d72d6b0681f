#include "bihive/job/camera_selections.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <variant>

#include "bihive/job/failure.h"
#include "bihive/job/selection.h"
#include "bihive/scene/clips.h"
#include "bihive/select/selection.h"

namespace bihive {

CameraSelections::CameraSelections(const PictureRequest& request, const SphereSet& spheres) {
  if (request.look_at)
    if (const auto* const selection = std::get_if<std::string>(&*request.look_at)) add("look_at", *selection, spheres);
  if (request.fit) add("fit", *request.fit, spheres);
  if (request.zoom_to) add("zoom_to", *request.zoom_to, spheres);
  if (request.view_of && !request.view_of->best_of.empty()) add("view_from", request.view_of->best_of, spheres);
}

void CameraSelections::add(const std::string& id, const std::string& selection, const SphereSet& spheres) {
  std::vector<std::uint8_t> mask = selected_or_fail(spheres, selection, id);
  if (std::count(mask.begin(), mask.end(), std::uint8_t{1}) == 0) {
    const std::string reason = what_there_is(spheres, selection);
    fail_setting(id, " \"" + selection + "\" selects no sphere" + (reason.empty() ? "" : ": " + reason),
                 reason.empty() ? "see bihive select" : "");
  }
  masks_[id] = std::move(mask);
}

std::vector<std::int64_t> CameraSelections::visible(const Scene& scene, const std::string& id) const {
  const std::vector<std::uint8_t>& mask = masks_.at(id);
  std::vector<std::int64_t> ids;
  for (std::int64_t stored = 0; stored < scene.spheres.size(); ++stored)
    if (mask[static_cast<std::size_t>(input_id(scene, stored))] != 0) ids.push_back(stored);
  ids = remaining_ids(scene, ids);
  if (ids.empty())
    fail_setting(id, ": all spheres of the selection are hidden or cut away", "show some of them, or select others");
  return ids;
}

}  // namespace bihive
