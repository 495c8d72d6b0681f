#include "bihive/io/frames/sphere_frames.h"

#include <algorithm>
#include <functional>

#include "bihive/io/assemble/finish.h"
#include "bihive/io/assemble/unit_cell.h"
#include "bihive/io/assemble/unknown_radii.h"
#include "bihive/io/text/text_scanner.h"
#include "bihive/io/without_throwing.h"

namespace bihive {
namespace {

// Numbers that change from frame to frame: velocities, forces, image flags, and other coordinates of LAMMPS' dumps.
constexpr std::string_view kMovingNumbers[] = {"vx", "vy", "vz", "fx", "fy", "fz", "ix",  "iy",  "iz",
                                               "xu", "yu", "zu", "xs", "ys", "zs", "xsu", "ysu", "zsu"};

// The numbers of the trajectory's frame in place of those of the file, which belong to another time.
void take_moving_numbers(std::vector<NamedNumbers> numbers, RawSpheres& raw) {
  std::vector<NamedNumbers>& kept = raw.attributes.numbers;
  std::string left_out;
  const auto is_moving = [&](const NamedNumbers& column) {
    return std::find(std::begin(kMovingNumbers), std::end(kMovingNumbers), column.name) != std::end(kMovingNumbers);
  };
  const auto is_replaced = [&](const NamedNumbers& column) {
    return std::any_of(numbers.begin(), numbers.end(), [&](const auto& one) { return one.name == column.name; });
  };
  for (const NamedNumbers& column : kept)
    if (is_moving(column) && !is_replaced(column)) left_out += " " + column.name;
  kept.erase(std::remove_if(kept.begin(), kept.end(),
                            [&](const NamedNumbers& column) { return is_moving(column) || is_replaced(column); }),
             kept.end());
  if (!left_out.empty())
    raw.rules.push_back("numbers of the atoms' file that change with time are left out:" + left_out);
  std::string taken;
  for (NamedNumbers& column : numbers) {
    taken += " " + column.name;
    kept.push_back(std::move(column));
  }
  if (!taken.empty()) raw.rules.push_back("numbers of the trajectory's frame:" + taken);
}

}  // namespace

Result<SphereFile> SphereFrames::open(std::int64_t frame) {
  return without_throwing(name_, [&] {
    return begin(open_raw_frames(name_, opened_at(frame), of_frames_.keep_index, options_.columns), frame);
  });
}

Result<SphereFile> SphereFrames::open(std::string_view bytes, std::int64_t frame) {
  return without_throwing(
      name_, [&] { return begin(open_raw_frames(bytes, name_, opened_at(frame), options_.columns), frame); });
}

Result<SphereFile> SphereFrames::begin(Result<OpenedFrames> opened, std::int64_t frame) {
  if (!opened) return opened.error();
  frames_ = std::move(opened->frames);
  RawSpheres raw = std::move(opened->wanted);
  if (is_moved()) {
    atoms_ = std::move(raw);
    Result<std::shared_ptr<const Trajectory>> trajectory = open_trajectory(options_.trajectory);
    if (!trajectory) return trajectory.error();
    trajectory_ = std::move(*trajectory);
    // A radius that is a guess is the file's own, so that it is the same in each frame; without coordinates in the
    // file, that of the first frame.
    if (!options_.radius && lacks_radii(atoms_)) {
      RawSpheres placed = atoms_;
      if (!atoms_.has_positions)
        if (Status status = take_places(0, placed); !status) return status.error();
      atoms_.unknown_radius = radius_from_neighbours(placed, cell_by_options(placed.cell, options_));
    }
    raw = atoms_;
  } else if (!raw.has_positions) {
    return Error{"this is a topology (" + raw.format + "), which has no coordinates", name_, 0, 0,
                 "give its trajectory too, as in 'bihive render ATOMS.psf FILE.dcd'"};
  }
  if (frame < 0) {
    // A number beyond the first frame stays, for the message.
    const std::int64_t numbered = numbered_frame(frame, is_moved() ? trajectory_->frame_count() : raw.frames);
    if (numbered >= 0) frame = numbered;
    if (!is_moved() && frame != 0) {
      Result<RawSpheres> read = frames_->read(frame);
      if (!read) return read.error();
      raw = std::move(*read);
    }
  }
  Result<SphereFile> made = made_of(std::move(raw), frame);
  if (made) count_ = made->frames;
  return made;
}

Result<SphereFile> SphereFrames::read(std::int64_t frame) const {
  return without_throwing(name_, [&]() -> Result<SphereFile> {
    if (is_moved()) return made_of(atoms_, frame);
    Result<RawSpheres> raw = frames_->read(frame);
    if (!raw) return raw.error();
    return made_of(std::move(*raw), frame);
  });
}

// The places, the cell and the time of the trajectory's frame in place of the file's.
Status SphereFrames::take_places(std::int64_t frame, RawSpheres& raw) const {
  const std::string& path = options_.trajectory;
  const std::int64_t count = trajectory_->sphere_count();
  if (count != static_cast<std::int64_t>(raw.size()))
    return Error{"the trajectory has " + std::to_string(count) + " atoms, and the file of the atoms has " +
                     std::to_string(raw.size()),
                 path, 0, 0, "both must be of the same simulation, with the same atoms left out"};
  Result<TrajectoryFrame> read = trajectory_->read(frame);
  if (!read) return read.error();
  raw.x = std::move(read->x);
  raw.y = std::move(read->y);
  raw.z = std::move(read->z);
  if (read->cell) raw.cell = read->cell;
  raw.time_ps = read->time_ps;
  raw.step = read->step;
  raw.warnings.insert(raw.warnings.end(), read->warnings.begin(), read->warnings.end());
  take_moving_numbers(std::move(read->numbers), raw);
  raw.frames = trajectory_->frame_count();
  raw.rules.push_back("places: frame " + std::to_string(frame) + " (from 0) of " + printable(path) + ", " +
                      trajectory_->format());
  raw.warnings.insert(raw.warnings.end(), trajectory_->warnings().begin(), trajectory_->warnings().end());
  return Done{};
}

// For means over frames.
Result<RawSpheres> SphereFrames::coordinates_at(std::int64_t frame) const {
  if (!is_moved()) return frames_->read(frame);
  Result<TrajectoryFrame> read = trajectory_->read(frame);
  if (!read) return read.error();
  RawSpheres raw;
  raw.x = std::move(read->x);
  raw.y = std::move(read->y);
  raw.z = std::move(read->z);
  raw.cell = read->cell ? read->cell : atoms_.cell;
  return raw;
}

// The spheres of a film keep their size: a radius that is a guess is the first frame's. If that frame cannot tell, each
// frame has its own.
std::optional<double> SphereFrames::radius_of_first_frame() const {
  const std::lock_guard<std::mutex> lock(first_radius_lock_);
  if (!first_radius_is_known_)
    if (const Result<RawSpheres> first = frames_->read(0); first && lacks_radii(*first))
      first_radius_ = radius_from_neighbours(*first, cell_by_options(first->cell, options_));
  first_radius_is_known_ = true;
  return first_radius_;
}

// All frames have one origin, unless the spheres go far away from it.
Vec3d SphereFrames::origin_of_first_frame() const {
  const std::lock_guard<std::mutex> lock(first_origin_lock_);
  if (!first_origin_)
    if (const Result<SphereFile> first = read(0)) first_origin_ = first->spheres.origin();
  if (!first_origin_) first_origin_.emplace();
  return *first_origin_;
}

Result<SphereFile> SphereFrames::made_of(RawSpheres raw, std::int64_t frame) const {
  raw.attributes.bonds.put_in_order();
  if (is_moved())
    if (Status status = take_places(frame, raw); !status) return status.error();
  if (!is_moved() && raw.frames > 1)
    names_.put_in_order(frame, raw, frames_->reads_each_apart(),
                        [this](std::int64_t other) { return frames_->read(other); });
  if (options_.smooth > 1)
    if (Status status = means_.smooth(frame, raw, options_, is_moved() ? options_.trajectory : name_,
                                      [this](std::int64_t other) { return coordinates_at(other); });
        !status)
      return status.error();
  if (frames_->may_be_cut()) raw.warnings.push_back("the last line of " + name_ + " has no end: the file may be cut");
  if (!options_.assembly.empty())
    if (Status status = expand_assembly(raw, options_.assembly, name_); !status) return status.error();
  std::vector<NamedTexts>& texts = raw.attributes.texts;
  texts.erase(std::remove_if(texts.begin(), texts.end(),
                             [](const NamedTexts& column) { return column.name == kAssemblyChains; }),
              texts.end());
  if (!is_moved() && frame != 0 && !options_.radius && lacks_radii(raw)) raw.unknown_radius = radius_of_first_frame();
  if (raw.size() == 0 && raw.frames > 1 && !of_frames_.empty_frames)
    return Error{"there are no spheres in frame " + std::to_string(frame) + " (read as " + raw.format + ")", name_, 0,
                 0, ""};
  std::function<Vec3d()> origin;
  if (frame != 0) origin = [this] { return origin_of_first_frame(); };
  return finish_spheres(std::move(raw), name_, options_, of_frames_.empty_frames, origin);
}

}  // namespace bihive
