// One comparer for every claim: an entry of values.json names a quantity of the experiment's data, and how it must
// compare with the value. thesis/README.md describes its members.
//
// Verdicts are texts: "agrees", "differs", "undecided" (the spread of our measurement reaches across the limit),
// "text_inconsistent" (the text contradicts itself: no value of ours could agree with all of it).
#pragma once

#include <string>

#include "experiment.h"

namespace bihive::thesis {

/// A finding for each entry with a claim whose quantity is in the data, as results.json has it: [{"name" (of the entry,
/// unique in its experiment), "claim", "row", "kind" (whose the value is), "expected", "ours", "verdict"}].
Json judge(const Values& values, const Json& data);

/// The wording of a verdict, by thesis/report/verdicts.json: {"words", "sign", "css_class"}. A quantity that agrees is
/// "reproduced" only if the text states it and nothing of ours was made to suit it; and only a quantity that the text
/// states can differ. So the verdict stands after the kind, "stated_agrees"; or it says why there is none,
/// "value_lost".
Json words_of(const std::string& verdict);
Json words_of(const Json& finding);

/// The claims of the text with their results: [{"section", "claim", "experiment", "verdict" (that of its worst finding,
/// after its kind; of a remark "value_lost", "not_compared", "tested"), "numbers" (ours in short, and the note), "why"
/// (the reason, if its verdict needs one), "found" (both)}], with the members of words_of() and "sentence" (that of its
/// first entry). Remarks have "found" alone.
Json claims_of(const Experiment& experiment);

}  // namespace bihive::thesis
