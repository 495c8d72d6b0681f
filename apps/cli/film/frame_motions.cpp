#include "film/frame_motions.h"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "bihive/base/setting_name.h"
#include "bihive/geometry/lattice.h"
#include "bihive/geometry/measures.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "bihive/job/selection.h"
#include "bihive/select/selection.h"
#include "support/interrupt.h"

namespace bihive::cli {
namespace {

struct SelectedCentres {
  std::vector<std::int64_t> ids;
  std::vector<Vec3d> centres;
};

SelectedCentres selected_centres(const SphereSet& spheres, const std::string& selection, const char* setting) {
  SelectedCentres selected;
  if (spheres.empty()) return selected;
  const std::vector<std::uint8_t> mask = selected_or_fail(spheres, selection, setting);
  for (std::int64_t id = 0; id < spheres.size(); ++id)
    if (mask[static_cast<std::size_t>(id)] != 0) {
      selected.ids.push_back(id);
      selected.centres.push_back(spheres.centre(id));
    }
  return selected;
}

[[noreturn]] void fail_empty(const char* setting, const std::string& selection, const SphereSet& spheres) {
  const std::string reason = what_there_is(spheres, selection);
  fail_setting(setting,
               " \"" + selection + "\" selects no sphere of the first frame" + (reason.empty() ? "" : ": " + reason));
}

// Calls use(frame of the film, its spheres) for all frames in their order.
template <class Use>
void for_each_frame(const FrameSource& source, const FilmPlan& plan, const Style& style, const char* task,
                    const Use& use) {
  Progress progress(task);
  for (std::int64_t k = 0; k < plan.asked.frames.count; ++k) {
    CancellableSection::leave_if_cancelled();
    use(k, source.load(plan.asked.frames.frame(k), style).scene.spheres);
    progress.update(static_cast<double>(k + 1) / static_cast<double>(plan.asked.frames.count));
  }
}

// From one frame to the next: how far the spheres have moved on average, by the shortest ways, and whether the first of
// them came in at another side of the cell: by which vector of the lattice, else 0.
struct Step {
  Vec3d moved, wrapped;
};
Step step_between(const SelectedCentres& before, const SelectedCentres& now, const std::optional<Lattice>& lattice) {
  if (before.ids != now.ids) {
    const Vec3d apart = mean_of(now.centres) - mean_of(before.centres);
    const Vec3d moved = shortest_image(apart, lattice);
    return {moved, apart - moved};
  }
  Vec3d sum;
  for (std::size_t i = 0; i < now.centres.size(); ++i)
    sum = sum + shortest_image(now.centres[i] - before.centres[i], lattice);
  const Vec3d apart = now.centres.front() - before.centres.front();
  return {sum / static_cast<double>(now.centres.size()), apart - shortest_image(apart, lattice)};
}

}  // namespace

std::vector<Vec3d> shifts_of(const FrameSource& source, const FilmPlan& plan, const std::string& selection,
                             const Style& style) {
  std::vector<Vec3d> shifts;
  SelectedCentres before;
  for_each_frame(source, plan, style, "followed spheres", [&](std::int64_t k, const SphereSet& spheres) {
    SelectedCentres now = selected_centres(spheres, selection, "follow");
    if (k == 0 && now.ids.empty()) fail_empty("follow", selection, spheres);
    shifts.push_back(k == 0 ? Vec3d{} : shifts.back());
    if (now.ids.empty()) return;
    if (k > 0) {
      const Step step = step_between(before, now, Lattice::of(spheres.cell()));
      shifts.back() = shifts.back() + (step.moved + step.wrapped);
    }
    before = std::move(now);
  });
  return shifts;
}

std::vector<RigidMotion> motions_of(const FrameSource& source, const FilmPlan& plan, const std::string& selection,
                                    const Style& style) {
  constexpr std::size_t kLeast = 3;  // fewer leave a turn open
  std::vector<RigidMotion> motions;
  std::vector<Vec3d> first;
  for_each_frame(source, plan, style, "aligned spheres", [&](std::int64_t k, const SphereSet& spheres) {
    if (spheres.has_images())
      fail_setting("align", " does not move the copies of " + setting_name("replicate"), "leave one of them out");
    SelectedCentres now = selected_centres(spheres, selection, "align");
    if (k == 0) {
      if (now.ids.empty()) fail_empty("align", selection, spheres);
      if (now.ids.size() < kLeast)
        fail_setting("align",
                     fmt::format(" \"{}\" selects {} of the spheres, and needs 3 or more", selection, now.ids.size()),
                     setting_name("follow") + " takes any number");
      first = std::move(now.centres);
      motions.emplace_back();
      return;
    }
    if (now.centres.size() != first.size())
      fail_setting("align",
                   fmt::format(" \"{}\" selects {} spheres in frame {}, and {} in frame {}", selection, first.size(),
                               plan.asked.frames.frame(0), now.centres.size(), plan.asked.frames.frame(k)),
                   "select by what stays the same, such as index");
    motions.push_back(superposition(now.centres, first));
  });
  return motions;
}

}  // namespace bihive::cli
