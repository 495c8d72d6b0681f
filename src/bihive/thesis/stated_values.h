// The values that experiments compare with: thesis/<experiment>/values.json. Each states its origin:
// the text, an inference of ours, or ours alone. The numbers that make the thesis's scenes are in scene/generators.cpp;
// Figure 4.1 compares the content of those scenes with the text's numbers.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/thesis/experiments.h"

namespace bihive {

/// One experiment's values. thesis/README.md describes the document:
///   {"values": {"scenario1.max_prims1.inner_nodes": {"value": 4095, "kind": "stated", "printed": "4,095",
///                                                    "sentence": "Nodes Internal 4,095 ..."}, ...}}
/// Other members of an entry are ignored.
class StatedValues {
 public:
  /// Error, with file and location: the document is not as above. `file`: as errors name it.
  static Result<StatedValues> parse(std::string_view bytes, std::string file);

  bool has(const std::string& name) const { return values_.count(name) != 0; }
  // Error, with file and location: there is no such value, or it is not a number, list of numbers, whole number.
  Result<double> number(const std::string& name) const;
  Result<std::int64_t> integer(const std::string& name) const;
  Result<std::vector<double>> numbers(const std::string& name) const;
  Result<std::vector<std::int64_t>> integers(const std::string& name) const;
  /// As the thesis prints it: "printed", unless that is another number; else the value as JSON.
  Result<std::string> printed(const std::string& name) const;
  const std::string& text() const { return text_; }  ///< the document as read

 private:
  struct Value {
    std::vector<double> numbers;  // a single number is a list of one; empty for a text
    bool is_list = false;
    std::string printed;
  };
  Result<Value> value(const std::string& name) const;
  Error error_at(const std::string& place, const std::string& expected) const;

  std::string file_, text_;
  std::map<std::string, Value> values_;
};

/// The thesis/*/values.json files embedded in the program (CMake): builtin_values_figure_4_1() and so on.
#define BIHIVE_DECLARE(name, id, section, title) std::string_view builtin_values_##name();
BIHIVE_THESIS_EXPERIMENTS(BIHIVE_DECLARE)
#undef BIHIVE_DECLARE

}  // namespace bihive
