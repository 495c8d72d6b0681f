// How bihive and bihive-thesis end: failures become messages and exit codes.
#pragma once

#include <exception>
#include <new>
#include <stdexcept>

#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "last_line.h"

namespace bihive {

/// The exit code that `run` returns, or that of its failure, after the message.
template <class Run>
int exit_code_of(const Run& run) {
  // Reporting an error may need memory too.
  try {
    try {
      return run();
    } catch (const Failure& failure) {
      say_error(failure.error.to_string());
      say_lines(failure.shown);
      return failure.code;
    } catch (const std::bad_alloc&) {
      say_no_memory();
    } catch (const std::length_error&) {
      say_no_memory();
    } catch (const std::exception& error) {
      say_error(error.what());
    }
  } catch (const std::exception&) {
    say_no_memory();
  }
  return kBadInput;
}

}  // namespace bihive
