// Words of the selection languages of PyMOL, VMD, MDAnalysis and OVITO that this language does not have.
#pragma once

#include <string_view>

namespace bihive {

/// What to write in place of such a word, for the hint of an error; empty: it is none. `word` as it is written: these
/// languages have their words in lower case.
std::string_view advice_on_foreign_word(std::string_view word);

}  // namespace bihive
