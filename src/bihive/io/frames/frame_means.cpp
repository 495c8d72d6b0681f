#include "bihive/io/frames/frame_means.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "bihive/base/setting_name.h"
#include "bihive/geometry/lattice.h"
#include "bihive/geometry/measures.h"
#include "bihive/io/assemble/unit_cell.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

const std::vector<double>* ids_of(const RawSpheres& spheres) {
  for (const NamedNumbers& column : spheres.attributes.numbers)
    if (lower_case(column.name) == "id") return &column.values;
  return nullptr;
}

// Why sphere i of one frame cannot be sphere i of the other; empty: it may be.
std::string difference(const RawSpheres& a, const RawSpheres& b) {
  if (a.size() != b.size()) return "have " + std::to_string(a.size()) + " and " + std::to_string(b.size()) + " spheres";
  const std::vector<std::uint8_t>&one = a.attributes.element, &other = b.attributes.element;
  if (!one.empty() && !other.empty() && one != other) return "have other elements in the same order of spheres";
  const std::vector<double>*const ids = ids_of(a), *const other_ids = ids_of(b);
  if (ids != nullptr && other_ids != nullptr && *ids != *other_ids) return "have spheres with other ids";
  return "";
}

Vec3d centre(const RawSpheres& spheres, std::size_t i) {
  return {spheres.x[i], spheres.y[i], spheres.z[i]};
}

// The parts of a frame that means are made of.
RawSpheres coordinates_of(RawSpheres spheres) {
  RawSpheres kept;
  kept.x = std::move(spheres.x);
  kept.y = std::move(spheres.y);
  kept.z = std::move(spheres.z);
  kept.cell = spheres.cell;
  kept.attributes.element = std::move(spheres.attributes.element);
  for (NamedNumbers& column : spheres.attributes.numbers)
    if (lower_case(column.name) == "id") kept.attributes.numbers.push_back(std::move(column));
  return kept;
}

}  // namespace

Result<FrameMeans::Kept> FrameMeans::at(std::int64_t frame, std::int64_t middle, std::int64_t width,
                                        const ReadFrame& read) {
  {
    const std::lock_guard<std::mutex> lock(lock_);
    if (const auto known = kept_.find(frame); known != kept_.end()) return known->second;
  }
  Result<RawSpheres> spheres = read(frame);
  if (!spheres) return spheres.error();
  const Kept made = std::make_shared<const RawSpheres>(coordinates_of(std::move(*spheres)));
  // A film that goes on by one frame at a time, on a few threads, reads each frame once more than without means.
  constexpr std::int64_t kMoreThanOneWindow = 4;
  const std::lock_guard<std::mutex> lock(lock_);
  kept_[frame] = made;
  while (static_cast<std::int64_t>(kept_.size()) > width + kMoreThanOneWindow) {
    const bool first_is_farther = middle - kept_.begin()->first > kept_.rbegin()->first - middle;
    kept_.erase(first_is_farther ? kept_.begin() : std::prev(kept_.end()));
  }
  return made;
}

Status FrameMeans::smooth(std::int64_t frame, RawSpheres& spheres, const ReadOptions& options, const std::string& file,
                          const ReadFrame& read) {
  const std::int64_t reach = std::min({options.smooth / 2, frame, spheres.frames - 1 - frame});
  if (options.smooth > 1 && spheres.frames == 1)
    spheres.warnings.push_back(setting_name("smooth") + " changes nothing: " + printable(file) + " has one frame");
  if (reach <= 0) return Done{};

  // Sums of displacements from the frame in the middle, forth and back.
  std::vector<Vec3d> sums(spheres.size());
  for (const std::int64_t step : {1, -1}) {
    Kept before;  // null: the frame in the middle
    std::vector<Vec3d> moved(spheres.size());
    for (std::int64_t k = 1; k <= reach; ++k) {
      Result<Kept> next = at(frame + step * k, frame, options.smooth, read);
      if (!next) return next.error();
      const RawSpheres &now = **next, &last = before ? *before : spheres;
      if (const std::string differs = difference(spheres, now); !differs.empty())
        return Error{setting_name("smooth") + " takes means over frames of the same spheres: frames " +
                         std::to_string(frame) + " and " + std::to_string(frame + step * k) + " " + differs,
                     file, 0, 0, "leave " + setting_name("smooth") + " out"};
      const std::optional<Lattice> lattice = Lattice::of(cell_by_options(now.cell, options));
      for (std::size_t i = 0; i < sums.size(); ++i) {
        moved[i] = moved[i] + shortest_image(centre(now, i) - centre(last, i), lattice);
        sums[i] = sums[i] + moved[i];
      }
      before = *next;
    }
  }

  const double frames = static_cast<double>(2 * reach + 1);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const Vec3d mean = centre(spheres, i) + sums[i] / frames;
    spheres.x[i] = mean.x;
    spheres.y[i] = mean.y;
    spheres.z[i] = mean.z;
  }
  spheres.rules.push_back("coordinates: means over frames " + std::to_string(frame - reach) + " to " +
                          std::to_string(frame + reach));
  return Done{};
}

}  // namespace bihive
