// The balls of a periodic set: those of one cell, and their images that matter for them.
#pragma once

#include <vector>

#include "bihive/base/result.h"
#include "bihive/geometry/lattice.h"
#include "bihive/measure/balls.h"

namespace bihive::measure {

/// Appends images to balls that have none, so that every ball of the cell has all balls that share a point with it.
/// `lattice` is in the units of the balls. Balls that lie a cell or more from the lowest ones are moved by whole cells
/// first; the counts are returned, ball by ball.
///
/// Centres and vectors are rounded to multiples of 2^-100 of the largest coordinate, and images are sums of them
/// without rounding: what is decided for balls is decided for their images.
///
/// Errors: a ball more than 2^13 cells from the others; so large balls, or so narrow a cell, that a ball may meet more
/// than 2^13 images; more than 2^28 images.
Result<std::vector<ImageCounts>> add_images(Balls& balls, const Lattice& lattice);

/// The number of a ball with this image, which is in the list; -1: it is not.
std::int64_t find_image(const Balls& balls, std::int64_t cell_balls, const Image& image);

}  // namespace bihive::measure
