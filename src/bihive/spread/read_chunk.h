// Reads a file's spheres in chunks, one per rank, with facts about the whole set.
#pragma once

#include <cstdint>
#include <string>

#include "bihive/base/result.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/io/read_spheres.h"
#include "bihive/scene/colour_by.h"
#include "bihive/scene/framing.h"
#include "bihive/scene/render_settings.h"
#include "bihive/scene/scene.h"
#include "bihive/spread/communicator.h"

namespace bihive {

/// Whether ranks can read chunks of this file (io/chunk_of_file.h): NPY, GSD, H5MD, LAMMPS dumps.
bool can_read_chunks_of(const std::string& path);

/// The spheres of this rank, with the radii, units and warnings of the whole set. Rank k of n has the rows from about
/// rows * k / n on.
struct ReadChunk {
  SphereFile file;
  std::int64_t whole_count = 0;
  SphereSet::Bounds whole_bounds;
};
/// For all ranks at the same time. `options`: those of radii and `recenter` alone. Errors as read_spheres(), on the
/// ranks that meet them, and if ranks see files of different shapes, sizes or contents, as far as samples show.
Result<ReadChunk> read_chunk(const std::string& path, const ReadOptions& options, Communicator& ranks);

/// Sets open ranges of the colours from the whole set. For all ranks at the same time. `chunk`: the spheres of this
/// rank.
void take_whole_range(const SphereSet& chunk, ColourBy& how, Communicator& ranks);

/// frame_picture() for the spheres of all ranks, at the same time. `chunk`: the scene with the spheres of this rank,
/// none of which clips remove. Not for View::tree.
Camera frame_whole_picture(const Scene& chunk, const SphereSet::Bounds& whole, const Side& side, const Lens& lens,
                           const RenderSettings& settings, Communicator& ranks);

}  // namespace bihive
