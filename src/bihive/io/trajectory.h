// Trajectories: the places of the same spheres at many times, without their names and sizes.
//
// A trajectory stays on the disk. Opening it finds where each frame begins; a frame is read when it is asked for.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/geometry/cell.h"
#include "bihive/geometry/sphere_attributes.h"

namespace bihive {

/// One frame. Lengths in Angstrom, whatever the format's own unit is.
struct TrajectoryFrame {
  std::vector<double> x, y, z;       ///< as many each as the trajectory has spheres; finite
  std::optional<Cell> cell;          ///< nothing: the frame states none
  std::optional<double> time_ps;     ///< picoseconds
  std::optional<std::int64_t> step;  ///< of the simulation
  /// What else the frame states of each sphere, in the file's unit: velocities vx vy vz, forces fx fy fz.
  std::vector<NamedNumbers> numbers;
  std::vector<std::string> warnings;  ///< remarks for the user on this frame, one line each
};

/// Any number of threads may read at a time.
class Trajectory {
 public:
  virtual ~Trajectory() = default;

  /// "DCD", "XTC", "TRR".
  virtual std::string format() const = 0;
  virtual std::int64_t frame_count() const = 0;
  virtual std::int64_t sphere_count() const = 0;
  /// Remarks for the user on the file as a whole, one line each.
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// Frame 0 to frame_count() - 1. Errors: no such frame; damaged bytes; the file changed meanwhile.
  virtual Result<TrajectoryFrame> read(std::int64_t frame) const = 0;

 protected:
  void warn(const std::string& warning) { warnings_.push_back(warning); }

 private:
  std::vector<std::string> warnings_;
};

/// Opens a trajectory by its content. Errors: no such file; another format; a damaged head. A file that ends inside a
/// frame has the frames before it, and a warning.
Result<std::shared_ptr<const Trajectory>> open_trajectory(const std::string& path);

}  // namespace bihive
