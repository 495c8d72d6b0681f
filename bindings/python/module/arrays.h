// Arrays of Python, read in place.
#pragma once

#include <pybind11/numpy.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "bihive/geometry/sphere_set.h"

namespace bihive::python {

/// Rows one after the other; others are copied.
template <class T>
using Array = pybind11::array_t<T, pybind11::array::c_style | pybind11::array::forcecast>;

/// One column of an array of float32 or float64 in this machine's byte order, any step in bytes between its numbers
/// (0: one number for all). The array must outlive it.
NumbersView column_of(const pybind11::array& array, pybind11::ssize_t column);

/// The numbers of a 1-D array.
NumbersView view_of(const pybind11::array& array);

/// Arrays of at most this many numbers are copied, which takes less time than the object that would own the vector.
inline constexpr std::size_t kFewNumbers = 256;

/// A new array of these numbers, which it owns.
template <class T>
pybind11::array_t<T> array_from(std::vector<T> values, std::vector<pybind11::ssize_t> shape) {
  if (values.size() <= kFewNumbers) {
    pybind11::array_t<T> array(std::move(shape));
    std::copy(values.begin(), values.end(), array.mutable_data());
    return array;
  }
  auto* const kept = new std::vector<T>(std::move(values));
  const pybind11::capsule owner(kept, [](void* vector) { delete static_cast<std::vector<T>*>(vector); });
  return pybind11::array_t<T>(std::move(shape), kept->data(), owner);
}

/// The entries of a C-contiguous array.
template <class T>
std::vector<T> vector_from(const Array<T>& array) {
  return std::vector<T>(array.data(), array.data() + array.size());
}

}  // namespace bihive::python
