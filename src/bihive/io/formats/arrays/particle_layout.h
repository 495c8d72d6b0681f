// Which arrays of a file hold the places, cells and numbers of particles.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/io/chunk.h"
#include "bihive/io/column_choice.h"
#include "bihive/io/formats/arrays/array_file.h"
#include "bihive/io/raw_spheres.h"
#include "bihive/io/trajectory.h"

namespace bihive {

/// An array whose first dimension may be the frames.
struct FramedArray {
  const ArrayFacts* array = nullptr;  ///< null: the file has none
  bool moves = false;
  double unit = 1;                  ///< its numbers are multiplied by this
  std::optional<double> fill = {};  ///< stands where a number was never written

  explicit operator bool() const { return array != nullptr; }
  /// The dimensions of one frame.
  std::vector<std::int64_t> lengths() const;
};

/// One number or vector for each particle.
struct ParticleColumn {
  FramedArray of;
  std::string name;  ///< of its part: "type"; a vector's get _1, _2, ... or stand in `names`
  std::vector<std::string> names = {};
};

struct ParticleLayout {
  std::string format;  ///< "H5MD", "AMBER NetCDF"
  FramedArray places;  ///< particles x 2 or 3, Angstrom where the file names its unit
  std::vector<ParticleColumn> columns;
  // The cell: three lengths or vectors as rows; or lengths and angles. Its corner is 0 where none is stated.
  FramedArray edges, lengths, angles, corner;
  std::array<bool, 3> periodic{true, true, true};  ///< Cell::periodic
  FramedArray time_ps, step;
  std::optional<double> first_step, steps_apart, first_time_ps, time_apart_ps;  ///< in place of arrays
  std::vector<std::string> rules, warnings;
};

/// The layout of the H5MD group that holds particles, "/particles/all"; an empty name: the only one, or the first.
/// Errors: there is none; its arrays do not fit each other.
Result<ParticleLayout> h5md_layout(const ArrayFile& file, const std::string& group);
/// AMBER's convention, which LAMMPS follows too.
Result<ParticleLayout> amber_layout(const ArrayFile& file);

/// The frames of a layout.
std::int64_t frame_count(const ParticleLayout& layout);
std::int64_t particle_count(const ParticleLayout& layout);

/// The particles of a chunk of one frame, which exists. Errors: numbers that cannot be places; the file cannot be read.
Result<RawSpheres> read_particles(const ArrayFile& file, const ParticleLayout& layout, std::int64_t frame,
                                  const ColumnChoice& choice, RowChunk chunk = {});
Result<TrajectoryFrame> read_places(const ArrayFile& file, const ParticleLayout& layout, std::int64_t frame);

/// 1 for Angstrom and what is not known, 10 for nanometres and so on; picoseconds in the same way, nothing if it is not
/// known.
double angstrom_of(const std::optional<std::string>& unit);
std::optional<double> picoseconds_of(const std::optional<std::string>& unit);

}  // namespace bihive
