// Long work without Python's lock, which Ctrl-C stops.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>

#include "bihive/job/waiting.h"

namespace bihive::python {

/// Does the work on a thread of its own. The calling thread waits, and several times per second it checks for signals
/// and calls `progress` (None, or a function of the finished share), in the end with 1. An exception of either cancels
/// the work, and is thrown after its end.
void wait_for(const std::function<void(Work&)>& work, const pybind11::object& progress);

/// Does the work of a query (wide/queries.h, wide/point_queries.h) on this thread and others, without Python's lock.
/// Between two pieces of its work this thread checks for signals several times per second; what a handler throws ends
/// the query, and is thrown here.
void do_query(const std::function<void()>& query);

}  // namespace bihive::python
