#include "bihive/job/selection.h"

#include "bihive/base/setting_name.h"
#include "bihive/job/failure.h"
#include "bihive/select/selection.h"

namespace bihive {

void fail_selection(const std::string& setting, const std::string& expression, const Error& error) {
  const std::string place = error.column > 0 ? " column " + std::to_string(error.column) + ":" : "";
  Failure failure{kBadUsage, Error{setting_name(setting) + ":" + place + " " + error.message, "", 0, 0, error.hint}};
  failure.shown = caret_lines(expression, error);
  failure.setting = setting;
  throw failure;
}

std::vector<std::uint8_t> selected_or_fail(const SphereSet& spheres, const std::string& expression,
                                           const std::string& setting) {
  Result<std::vector<std::uint8_t>> mask = select_spheres(spheres, expression);
  if (!mask) fail_selection(setting, expression, mask.error());
  return std::move(*mask);
}

}  // namespace bihive
