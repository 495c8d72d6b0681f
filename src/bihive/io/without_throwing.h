// For functions that promise not to throw: lack of memory becomes an error, and so does a cancelled reading.
#pragma once

#include <exception>
#include <new>
#include <string>

#include "bihive/base/memory.h"
#include "bihive/base/result.h"
#include "bihive/base/watch.h"

namespace bihive {

/// The answer of `body`, a Result; an error if it throws. `name` is the file's, for messages. The work is watched.
template <class Body>
auto without_throwing(const std::string& name, const Body& body) -> decltype(body()) {
  WatchedWork work(WatchedWork::InnerProgress::passed_on);
  try {
    auto answer = body();
    if (answer && !work.is_nested()) work.report(1);
    return answer;
  } catch (const Cancelled&) {
    if (work.is_nested()) throw;
    return cancelled_error();
  } catch (const std::bad_alloc&) {
    return Error{no_memory_for("reading it").message, name, 0, 0, ""};
  } catch (const std::exception& e) {
    return Error{"reading failed: " + std::string(e.what()), name, 0, 0, ""};
  }
}

}  // namespace bihive
