// The text of the last failure, and the boundary that no exception crosses.
#pragma once

#include <exception>
#include <new>

#include "bihive.h"
#include "bihive/base/result.h"
#include "bihive/job/failure.h"

namespace bihive::c {

constexpr int kDone = 0;
constexpr int kFailed = 1;
constexpr int kCancelled = BIHIVE_CANCELLED;

/// Stores the text for bihive_error_text() of this thread, without heap memory; truncates very long ones.
int failed(const char* text) noexcept;
/// kCancelled if that is what the error says.
int failed(const Error& error);
const char* last_error() noexcept;

/// body() returns kDone, kFailed or kCancelled.
template <class Body>
int guarded(const Body& body) noexcept {
  try {
    return body();
  } catch (const Failure& failure) {
    return failed(failure.error);
  } catch (const std::bad_alloc&) {
    return failed("not enough memory");
  } catch (const std::exception& error) {
    return failed(error.what());
  } catch (...) {
    return failed("an unknown failure");
  }
}

}  // namespace bihive::c
