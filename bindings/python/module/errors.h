// Failures of the library and of the options' checks as Python's exceptions.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/job/failure.h"

namespace bihive::python {

/// Makes a Failure that leaves a function of the module the exception that bihive/_errors.py makes of it.
void translate_failures();

/// Warnings as the command line prints them, which Python can hold: its strings are UTF-8.
std::vector<std::string> safe_texts(const std::vector<std::string>& texts);

/// The value, or a Failure about an argument.
template <class T>
T value_of(Result<T> result) {
  return value_or_fail(std::move(result));
}

}  // namespace bihive::python
