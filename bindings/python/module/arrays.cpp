#include "arrays.h"

#include "bihive/base/check.h"

namespace py = pybind11;

namespace bihive::python {
namespace {

NumbersView numbers_at(const py::array& array, const void* first, py::ssize_t step) {
  NumbersView view;
  view.first = first;
  view.step_bytes = step;
  view.count = static_cast<std::size_t>(array.shape(0));
  const bool is_double = py::isinstance<py::array_t<double>>(array);
  BIHIVE_CHECK(is_double || py::isinstance<py::array_t<float>>(array));
  view.precision = is_double ? NumbersView::Precision::binary64 : NumbersView::Precision::binary32;
  return view;
}

}  // namespace

NumbersView column_of(const py::array& array, py::ssize_t column) {
  BIHIVE_CHECK(array.ndim() == 2 && column < array.shape(1));
  const auto* const first = static_cast<const char*>(array.data());
  return numbers_at(array, first + column * array.strides(1), array.strides(0));
}

NumbersView view_of(const py::array& array) {
  BIHIVE_CHECK_EQ(array.ndim(), py::ssize_t{1});
  return numbers_at(array, array.data(), array.strides(0));
}

}  // namespace bihive::python
