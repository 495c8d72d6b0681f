// Values of the frame in the title of a picture: "t = {time:.1f} ps".
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bihive/base/result.h"

namespace bihive {

/// A name and its value; NaN: the frame does not state it.
using TitleValues = std::vector<std::pair<std::string, double>>;

/// The text with each {name} replaced by its value, at most six digits long; {name:.2f} has two digits after the point.
/// {{ and }} are braces. Errors: no such name (the message lists all), a value that the frame does not state, a brace
/// without its partner.
Result<std::string> fill_title(const std::string& text, const TitleValues& values);

}  // namespace bihive
