// The words of selections that stand alone: all, none, hydrogen, water, protein ...
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/geometry/sphere_set.h"

namespace bihive {

/// In the order in which messages list them; plural forms are known too, but not listed.
std::vector<std::string> selection_words();
/// `word` is in lower case.
bool is_selection_word(std::string_view word);

/// One byte for each sphere. Error: the set lacks the columns that the word needs.
Result<std::vector<std::uint8_t>> mask_of_word(std::string_view word, const SphereSet& spheres);

}  // namespace bihive
