#include "errors.h"

#include <pybind11/pybind11.h>

#include <exception>
#include <string>

namespace py = pybind11;

namespace bihive::python {
namespace {

const char* kind_of(cli::ExitCode code) {
  switch (code) {
    case cli::kBadUsage:
      return "usage";
    case cli::kEnvironment:
      return "missing";
    default:
      return "input";
  }
}

// Bytes that are no UTF-8, as a path may have them, are escaped.
py::str text_of(const std::string& bytes) {
  PyObject* const text = PyUnicode_DecodeUTF8(bytes.data(), static_cast<Py_ssize_t>(bytes.size()), "backslashreplace");
  if (text == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::str>(text);
}

void raise(const cli::Failure& failure) {
  const Error& error = failure.error;
  try {
    const py::object made = py::module_::import("bihive._errors")
                                .attr("failure")(kind_of(failure.code), text_of(error.message), text_of(error.file),
                                                 error.line, error.column, text_of(error.hint), text_of(failure.shown));
    PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(made.ptr())), made.ptr());
  } catch (py::error_already_set& other) {
    other.restore();
  }
}

}  // namespace

void translate_failures() {
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const cli::Failure& failure) {
      raise(failure);
    }
  });
}

}  // namespace bihive::python
