// The thesis's stated values: thesis/<experiment>/values.json, built into the program. No number of the thesis stands
// in code.
#pragma once

#include <string>
#include <vector>

#include "thesis/section.h"

namespace bihive::cli::thesis {

/// One experiment's values. Document:
///   {"experiment": "table-4.2",
///    "values": {"scenario1.max_prims1.inner_nodes": {"value": 4095, "printed": "4,095", "sentence": "Nodes Internal
///    4,095 ..."}, ...}}
/// "value" is a number or a list of numbers; "printed" is optional; "sentence" says where in the text it stands, or,
/// with "chosen": true, why it was chosen where the text is silent.
class Values {
 public:
  /// Fails (failure.h) with file and place if the document is not as above.
  Values(const std::string& bytes, const std::string& file);

  /// Fails if the name is unknown, because every value that code needs must be in the file.
  double number(const std::string& name) const;
  std::int64_t integer(const std::string& name) const;
  std::vector<double> numbers(const std::string& name) const;
  bool has(const std::string& name) const;
  /// As the thesis prints it: "printed", else the value; also where "printed" is another number than the value.
  std::string printed(const std::string& name) const;
  std::string sentence(const std::string& name) const;
  const Json& document() const { return document_; }

 private:
  const Json& entry(const std::string& name) const;

  std::string file_;
  Json document_;
};

/// The values of folder/<experiment>/values.json if a folder is given and has that file, else the built-in ones.
Values load_values(const std::string& experiment, const std::string& folder);

}  // namespace bihive::cli::thesis
