// Faults of CIF's grammar.
#pragma once

#include <cstddef>
#include <cstdint>
#include <gemmi/cif.hpp>
#include <stdexcept>
#include <string>

#include "bihive/base/result.h"

namespace bihive {

/// The text breaks the rules of CIF. In place of pegtl::parse_error, which writes its position by streams, and these
/// bring every locale into the page's module (20 kB of its download).
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

/// gemmi::cif::Action with that.
template <class Rule>
struct CifActions : gemmi::cif::Action<Rule> {};
template <>
struct CifActions<gemmi::cif::rules::loop> {
  template <class Input>
  static void apply(const Input& in, gemmi::cif::Document& out) {
    const gemmi::cif::Loop& loop = out.items_->back().loop;
    const std::size_t values = loop.values.size() % loop.tags.size();
    if (values != 0)
      throw CifFault("the last row of this loop has " + std::to_string(values) + " of its " +
                         std::to_string(loop.tags.size()) + " values",
                     in.position());
  }
};

}  // namespace bihive
