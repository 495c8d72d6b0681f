// Numbers from the fields of a line, with errors that have their place.
#pragma once

#include <cstdint>
#include <string>

#include "bihive/base/result.h"
#include "bihive/io/text/text_scanner.h"
#include "bihive/math/vec3.h"

namespace bihive {

/// The next field as a finite number that can be a coordinate. `what` is for the message: "x".
Result<double> take_number(TextScanner& scanner, const std::string& what);

/// The next three fields as x, y and z.
Result<Vec3d> take_place(TextScanner& scanner);

/// The next field as a whole number from 0.
Result<std::int64_t> take_count(TextScanner& scanner, const std::string& what);

}  // namespace bihive
