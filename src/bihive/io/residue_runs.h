// Residues of a set: which spheres belong to one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "bihive/geometry/sphere_attributes.h"

namespace bihive {

/// A number for each of `count` spheres, equal in each residue: a run of spheres, one after the other, that agree in
/// their residue's number and in the texts `chain`, `entity`, `insertion` and `resname`, as far as there are any.
/// `number` gives that of a sphere; two unknown ones (NaN) differ.
std::vector<std::int32_t> residue_runs(const SphereAttributes& attributes, std::size_t count,
                                       const std::function<double(std::size_t)>& number);

}  // namespace bihive
