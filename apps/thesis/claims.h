// One comparer for every claim: an entry of values.json names a quantity of the experiment's data, and how it must
// compare with the value.
//
//   "claim": the sentence, as short as a line; entries with the same claim are its rows
//   "row": the part of the sentence that is this entry's own; optional if the claim has one entry
//   "of": a path into the data, "trees.b.leaves"; left out: the entry's name
//   "is": how the quantity must compare with "value"; left out: "equal". See claims.cpp.
//   "tolerance": the tolerance of "is", if it has one; 0 by default
//   "prefix", "unit", "decimals", "key", "expects": how the quantity is written (before a number, after it, its digits,
//   before the keys of a map), and what is expected where the value alone says too little
//   "contradicts": what else the text says; where the quantity is another one, the text contradicts itself
//   "reason": shown where the claim does not simply agree
//   "note": always shown
//   "section", "held_by": the section of the text, by default the experiment's, and the tests that check the claim
#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiment.h"

namespace bihive::thesis {

/// How a quantity of ours compares with an expected value.
enum class Verdict {
  agrees,
  differs,
  undecided,         ///< the spread of our measurement reaches across the limit
  text_inconsistent  ///< the text contradicts itself: no value of ours could agree with all of it
};
/// For machines: "agrees", "differs", "undecided", "text_inconsistent".
const char* name_of(Verdict verdict);

/// How a verdict is written: its words, a sign and a CSS class. A quantity that agrees is "reproduced" only if the text
/// states it and nothing of ours was made to suit it; and only a quantity that the text states can differ.
struct Words {
  const char *words, *sign, *css_class;
};
Words words_of(Verdict verdict, ValueKind kind);

/// One comparison.
struct Finding {
  std::string name;  ///< of the entry, unique in its experiment
  std::string claim, row, expected, ours;
  Verdict verdict;
  ValueKind kind;
};

/// A finding for each entry with a claim whose quantity is in the data.
std::vector<Finding> judge(const Values& values, const Json& data);

/// The finding of one entry on another quantity; nothing if there is no such quantity.
std::vector<Finding> judge_on(const Values& values, const std::string& name, const Json& data, const std::string& path);

/// A claim of the text with what became of it, for the report's list and for docs/thesis_map.md.
struct Claim {
  std::string section, claim, experiment;
  std::string sentence;  ///< of its first entry
  std::vector<const Finding*> findings;
  /// The worst of its findings; of a remark "value lost" or "not compared".
  Words words;
  std::string verdict;               ///< for machines
  std::string found;                 ///< our numbers in short, the note, and the reason where it applies
  std::vector<std::string> held_by;  ///< tests
};
std::vector<Claim> claims_of(const Experiment& experiment, const Values& values, const std::vector<Finding>& findings);

}  // namespace bihive::thesis
