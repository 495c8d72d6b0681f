// Texts against the values of a selection.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bihive/geometry/sphere_set.h"
#include "bihive/select/expression.h"

namespace bihive {

/// For each text, whether any value is equal to it, upper and lower case being different. In a value without quotes `*`
/// stands for any characters, also for none.
std::vector<bool> texts_that_match(const std::vector<std::string>& texts, const std::vector<SelectionValue>& values);

/// `chain = A` and `element != C` as a name with values, if the comparison is of that form: = or != between the name of
/// a text or of the element, and a text. The caller inverts the answer for !=.
std::optional<Expression> comparison_of_texts(const Expression& comparison, const SphereSet& spheres);

}  // namespace bihive
