// Faults of CIF's grammar.
#pragma once

#include <cstdint>
#include <gemmi/cif.hpp>
#include <stdexcept>
#include <string>

#include "bihive/base/result.h"

namespace bihive {

/// The text breaks the rules of CIF. In place of pegtl::parse_error, which writes its position by streams, and these
/// bring every locale into the page's module.
struct CifFault : std::runtime_error {
  CifFault(const std::string& message, const tao::pegtl::position& at)
      : std::runtime_error(message),
        line(static_cast<std::int64_t>(at.line)),
        column(static_cast<std::int64_t>(at.column)) {}

  Error in(const std::string& file) const { return {"this is no CIF: " + std::string(what()), file, line, column, ""}; }

  std::int64_t line, column;
};

/// gemmi::cif::Errors with that.
template <class Rule>
struct CifErrors : tao::pegtl::normal<Rule> {
  template <class Input, class... States>
  [[noreturn]] static void raise(const Input& in, States&&... /*unused*/) {
    throw CifFault(gemmi::cif::error_message<Rule>(), in.position());
  }
};

}  // namespace bihive
