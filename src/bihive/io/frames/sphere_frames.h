// From the frames of a file to sets of spheres: what open_frames() and read_spheres() share.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "bihive/base/result.h"
#include "bihive/io/frames.h"
#include "bihive/io/frames/frame_means.h"
#include "bihive/io/frames/frame_names.h"
#include "bihive/io/frames/raw_frames.h"
#include "bihive/io/read_spheres.h"
#include "bihive/io/trajectory.h"

namespace bihive {

class SphereFrames : public Frames {
 public:
  SphereFrames(std::string name, ReadOptions options, FramesOptions of_frames = {})
      : name_(std::move(name)), options_(std::move(options)), of_frames_(of_frames) {}

  /// Opens the file, or the bytes, which must outlive it, and the trajectory if there is one. Reads a frame on the way;
  /// one less than 0 counts from the end.
  Result<SphereFile> open(std::int64_t frame);
  Result<SphereFile> open(std::string_view bytes, std::int64_t frame);

  std::int64_t count() const override { return count_; }
  std::vector<std::string> warnings() const override { return frames_->warnings(); }
  Result<SphereFile> read(std::int64_t frame) const override;

 private:
  bool is_moved() const { return !options_.trajectory.empty(); }
  // The frame that is read when the file is opened; the number of frames is not known yet.
  std::int64_t opened_at(std::int64_t frame) const { return is_moved() ? 0 : std::max<std::int64_t>(frame, 0); }
  Result<SphereFile> begin(Result<OpenedFrames> opened, std::int64_t frame);
  Result<SphereFile> made_of(RawSpheres raw, std::int64_t frame) const;
  Status take_places(std::int64_t frame, RawSpheres& raw) const;
  Result<RawSpheres> coordinates_at(std::int64_t frame) const;
  std::optional<double> radius_of_first_frame() const;
  Vec3d origin_of_first_frame() const;

  std::string name_;
  ReadOptions options_;
  FramesOptions of_frames_;
  std::int64_t count_ = 0;
  std::shared_ptr<const RawFrames> frames_;
  // With a trajectory: the atoms, and the places.
  RawSpheres atoms_;
  std::shared_ptr<const Trajectory> trajectory_;
  // For spheres with neither radius nor element; found when it is asked for.
  mutable std::mutex first_radius_lock_;
  mutable bool first_radius_is_known_ = false;
  mutable std::optional<double> first_radius_;
  // For spheres far from 0; found when it is asked for.
  mutable std::mutex first_origin_lock_;
  mutable std::optional<Vec3d> first_origin_;
  mutable FrameNames names_;
  mutable FrameMeans means_;
};

}  // namespace bihive
