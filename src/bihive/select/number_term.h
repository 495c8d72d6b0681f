// Arithmetic of a selection, with its names looked up in one set.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/select/attribute_names.h"
#include "bihive/select/expression.h"

namespace bihive {

struct ResolvedTerm {
  NumberTerm::Kind kind = NumberTerm::Kind::number;
  double number = 0;
  FoundAttribute attribute;
  std::vector<ResolvedTerm> operands;
  std::string signs;

  /// In binary64; NaN where a number is unknown.
  double value(const SphereSet& spheres, std::int64_t id) const;
  bool differs_by_image() const;
};

/// `text` is the selection's, for the places in errors. Errors: an unknown name, or one that holds no numbers.
Result<ResolvedTerm> resolve_term(const NumberTerm& term, std::string_view text, const SphereSet& spheres);

/// What a name stands for (find_attribute()), or else arithmetic of names that hold numbers: "vx^2 + vy^2". Error: it
/// is neither, with what there is.
Result<FoundAttribute> find_numbers(const SphereSet& spheres, std::string_view text);

}  // namespace bihive
