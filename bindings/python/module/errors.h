// Failures of the library and of the options' checks as Python's exceptions.
#pragma once

#include <utility>

#include "bihive/base/result.h"
#include "support/failure.h"

namespace bihive::python {

/// From now on a cli::Failure that leaves a function of the module becomes the exception that bihive/_errors.py makes
/// of it.
void translate_failures();

/// The value, or a Failure about an argument.
template <class T>
T value_of(Result<T> result) {
  return cli::value_or_fail(std::move(result));
}

}  // namespace bihive::python
