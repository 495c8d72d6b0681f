#include "errors.h"

#include <pybind11/pybind11.h>

#include <exception>
#include <string>

#include "bihive/base/readable.h"

namespace py = pybind11;

namespace bihive::python {
namespace {

const char* kind_of(ExitCode code) {
  switch (code) {
    case kBadUsage:
      return "usage";
    case kEnvironment:
      return "missing";
    default:
      return "input";
  }
}

void raise(const Failure& failure) {
  const Error& error = failure.error;
  try {
    // Texts may contain bytes that are not UTF-8, which Python cannot make a str of; names of files are converted
    // separately.
    const auto file = py::reinterpret_steal<py::str>(
        PyUnicode_DecodeFSDefaultAndSize(error.file.data(), static_cast<Py_ssize_t>(error.file.size())));
    const py::object made =
        py::module_::import("bihive._errors")
            .attr("failure")(kind_of(failure.code), escaped(error.message), file, error.line, error.column,
                             escaped(error.hint), escaped_lines(failure.shown), failure.setting, error.system_code);
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
    } catch (const Failure& failure) {
      raise(failure);
    }
  });
}

std::vector<std::string> safe_texts(const std::vector<std::string>& texts) {
  std::vector<std::string> safe;
  safe.reserve(texts.size());
  for (const std::string& text : texts) safe.push_back(escaped(text));
  return safe;
}

}  // namespace bihive::python
