#include "errors.h"

#include <pybind11/pybind11.h>

#include <exception>

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

void raise(const cli::Failure& failure) {
  const Error& error = failure.error;
  try {
    const py::object made = py::module_::import("bihive._errors")
                                .attr("failure")(kind_of(failure.code), error.message, error.file, error.line,
                                                 error.column, error.hint, failure.shown);
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
