#include "waiting.h"

#include <exception>

#include "bihive/base/watch.h"

namespace py = pybind11;

namespace bihive::python {
namespace {

// The exception that a signal's handler or the progress function throws; null: none. Takes Python's lock.
std::exception_ptr look(const py::object* progress, double done) {
  const py::gil_scoped_acquire lock;
  try {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (progress != nullptr && !progress->is_none()) (*progress)(done);
  } catch (py::error_already_set&) {
    return std::current_exception();
  }
  return nullptr;
}

}  // namespace

void wait_for(const std::function<void(Work&)>& work, const py::object& progress) {
  std::exception_ptr of_caller, of_work;
  {
    const py::gil_scoped_release unlocked;
    try {
      wait_for_work(work, [&](double done) {
        of_caller = look(&progress, done);
        return of_caller == nullptr;
      });
    } catch (...) {
      of_work = std::current_exception();
    }
  }
  if (of_caller) std::rethrow_exception(of_caller);
  if (of_work) std::rethrow_exception(of_work);
  // The work is done, and the caller has Python's lock.
  if (!progress.is_none()) progress(1.0);
}

void do_query(const std::function<void()>& query) {
  std::exception_ptr of_signal, of_query;
  {
    const py::gil_scoped_release unlocked;
    const Watch watch({}, nullptr, [&](double) {
      of_signal = look(nullptr, 0);
      return of_signal == nullptr;
    });
    WatchedWork work;
    try {
      query();
    } catch (...) {
      of_query = std::current_exception();
    }
  }
  if (of_signal) std::rethrow_exception(of_signal);
  if (of_query) std::rethrow_exception(of_query);
}

}  // namespace bihive::python
