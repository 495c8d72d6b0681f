// The thesis's stated values (bihive/thesis/stated_values.h) for experiments: if a value is missing or of another kind,
// the program fails (failure.h), because every value that code needs must be in the file.
#pragma once

#include <string>
#include <vector>

#include "bihive/thesis/stated_values.h"
#include "support/failure.h"
#include "thesis/section.h"

namespace bihive::cli::thesis {

class Values {
 public:
  Values(const std::string& bytes, const std::string& file);

  bool has(const std::string& name) const { return stated_.has(name); }
  double number(const std::string& name) const { return value_or_fail(stated_.number(name)); }
  std::int64_t integer(const std::string& name) const { return value_or_fail(stated_.integer(name)); }
  std::vector<double> numbers(const std::string& name) const { return value_or_fail(stated_.numbers(name)); }
  std::vector<std::int64_t> integers(const std::string& name) const { return value_or_fail(stated_.integers(name)); }
  std::string printed(const std::string& name) const { return value_or_fail(stated_.printed(name)); }
  std::string sentence(const std::string& name) const { return value_or_fail(stated_.sentence(name)); }
  ValueKind kind(const std::string& name) const { return value_or_fail(stated_.kind(name)); }
  const StatedValues& stated() const { return stated_; }
  const Json& document() const { return document_; }

 private:
  StatedValues stated_;
  Json document_;
};

/// The values of folder/<experiment>/values.json if a folder is given and has that file, else the built-in ones.
Values load_values(const std::string& experiment, const std::string& folder);

}  // namespace bihive::cli::thesis
