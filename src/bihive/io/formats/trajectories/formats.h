// One opener for each format of trajectories. Each takes a file whose first bytes are the format's.
#pragma once

#include <memory>
#include <string_view>

#include "bihive/base/result.h"
#include "bihive/io/packed/random_file.h"
#include "bihive/io/trajectory.h"

namespace bihive {

bool looks_like_dcd(std::string_view first_bytes);
/// CHARMM, NAMD, X-PLOR, LAMMPS: Fortran records in either byte order.
Result<std::shared_ptr<const Trajectory>> open_dcd(RandomFile file);

bool looks_like_xtc(std::string_view first_bytes);
/// GROMACS, compressed: io/formats/trajectories/packed_places.h.
Result<std::shared_ptr<const Trajectory>> open_xtc(RandomFile file);

bool looks_like_trr(std::string_view first_bytes);
/// GROMACS, single or double precision.
Result<std::shared_ptr<const Trajectory>> open_trr(RandomFile file);

/// The error for a frame that the trajectory does not have.
Error no_such_trajectory_frame(const Trajectory& trajectory, const std::string& path, std::int64_t frame);

/// Why these numbers cannot be places: one is not finite. Nothing: they can.
Status check_places(const TrajectoryFrame& frame, const std::string& path, std::int64_t number);

/// A cell from nine numbers of three vectors, times `unit`; nothing if all are 0 or one is not finite.
std::optional<Cell> cell_of_nine(const double (&v)[9], double unit);

}  // namespace bihive
