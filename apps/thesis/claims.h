// One comparer for every claim: an entry of values.json names a quantity of the experiment's data, and how it must
// compare with the value.
//
//   "claim": the sentence, as short as a line; entries with the same claim are its rows
//   "row": the part of the sentence that is this entry's own; optional if the claim has one entry
//   "of": a path into the data, "trees.b.leaves"; left out: the entry's name
//   "is": how the quantity must compare with "value"; left out: "equal". See claims.cpp.
//   "tolerance": the tolerance of "is", if it has one; 0 by default
//   "prefix", "unit", "decimals", "key", "expects": how the quantity is written (before a number, after it, its digits,
//   before the keys of a map), and what is expected if the value alone is unclear
//   "contradicts": another statement of the text; if the quantity differs, the text contradicts itself
//   "reason": shown if the claim does not simply agree
//   "note": always shown
//   "section", "held_by": the section of the text, by default the experiment's, and the tests that check the claim
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
/// after its kind; of a remark "value_lost", "not_compared", "tested"), "found" (our numbers in short, the note, and
/// the reason where it applies)}], with the members of words_of() and "sentence" (that of its first entry).
Json claims_of(const Experiment& experiment);

}  // namespace bihive::thesis
