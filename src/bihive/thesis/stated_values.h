// The values that experiments compare with: thesis/<experiment>/values.json (builtin_values.h). Each states its origin:
// the text, an inference of ours, or ours alone. The numbers that make the thesis's scenes are in scene/generators.cpp;
// Figure 4.1 compares the content of those scenes with the text's numbers.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "bihive/base/result.h"

namespace bihive {

/// One value of an experiment.
struct StatedValue {
  std::vector<double> numbers;  ///< a single number is a list of one; empty for a text
  bool is_list = false;
  std::string printed;  ///< as the thesis prints it: "printed", unless that is another number; else the value as JSON
  std::string sentence;
  /// The origin of a value. Only a comparison with "stated" can reproduce the thesis, or differ from it.
  ///  - "stated": the text says it, of an outcome
  ///  - "set": the text says it, and our scenes are made with it; it can only be copied well or badly
  ///  - "fitted": the text says it, and something of ours was made to suit it: the builder, sizes, costs
  ///  - "inferred": the text is silent or vague; we conclude, choose or read it so, for the reason beside it
  ///  - "own_check": a result of ours that another implementation or an argument of ours must confirm
  std::string kind;
};

/// One experiment's values. Document:
///   {"experiment": "table-4.2",
///    "values": {"scenario1.max_prims1.inner_nodes": {"value": 4095, "kind": "stated", "printed": "4,095",
///                                                    "sentence": "Nodes Internal 4,095 ..."}, ...}}
/// "value" is a number, a list of numbers, or a text. "kind" is one of the five above. "printed" is optional.
/// "sentence" quotes the text, or gives the reasoning where the value is not the text's. Other members are ignored.
class StatedValues {
 public:
  /// Error, with file and location: the document is not as above. `file`: as errors name it.
  static Result<StatedValues> parse(std::string_view bytes, std::string file);

  bool has(const std::string& name) const { return values_.count(name) != 0; }
  // Error, with file and location: there is no such value, or it is not a number, list of numbers, whole number.
  Result<StatedValue> value(const std::string& name) const;
  Result<double> number(const std::string& name) const;
  Result<std::int64_t> integer(const std::string& name) const;
  Result<std::vector<double>> numbers(const std::string& name) const;
  Result<std::vector<std::int64_t>> integers(const std::string& name) const;
  const std::string& text() const { return text_; }  ///< the document as read

 private:
  Error error_at(const std::string& place, const std::string& expected) const;

  std::string file_, text_;
  std::map<std::string, StatedValue> values_;
};

}  // namespace bihive
