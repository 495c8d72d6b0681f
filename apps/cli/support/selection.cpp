#include "support/selection.h"

#include "bihive/select/selection.h"
#include "support/failure.h"

namespace bihive::cli {

void fail_selection(const std::string& option, const std::string& expression, const Error& error) {
  const std::string place = error.column > 0 ? " column " + std::to_string(error.column) + ":" : "";
  Failure failure{kBadUsage, Error{option + ":" + place + " " + error.message, "", 0, 0, error.hint}};
  failure.shown = caret_lines(expression, error);
  throw failure;
}

std::vector<std::uint8_t> selected_or_fail(const SphereSet& spheres, const std::string& expression,
                                           const std::string& option) {
  Result<std::vector<std::uint8_t>> mask = select_spheres(spheres, expression);
  if (!mask) fail_selection(option, expression, mask.error());
  return std::move(*mask);
}

}  // namespace bihive::cli
