// Options whose values have a syntax of their own, as CLI11 takes them.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "bihive/base/parse_number.h"
#include "bihive/base/result.h"

namespace bihive::cli {

/// An option with one value of its own syntax: `parse` turns the text into a Result.
template <class Target, class Parse>
CLI::Option* add_value(CLI::App& app, const std::string& name, Target& target, const std::string& type,
                       const std::string& help, Parse parse) {
  const auto take = [&target, name, parse](const std::string& text) {
    auto value = parse(text);
    if (!value) throw CLI::ValidationError(name, value.error().to_string());
    target = *value;
  };
  return app.add_option_function<std::string>(name, take, help)->type_name(type);
}

template <class Target>
CLI::Option* add_integer(CLI::App& app, const std::string& name, Target& target, std::int64_t min, std::int64_t max,
                         const std::string& help) {
  return add_value(app, name, target, "N", help,
                   [min, max](const std::string& text) { return whole_number_from_text(text, min, max); });
}

/// The names between commas, each once; `named` turns one into a Result.
template <class T, class Named>
Result<std::vector<T>> list_from_text(const std::string& text, const Named& named) {
  std::vector<T> list;
  for (std::size_t first = 0; first <= text.size();) {
    const std::size_t end = std::min(text.find(',', first), text.size());
    const std::string name = text.substr(first, end - first);
    Result<T> one = named(name);
    if (!one) return one.error();
    if (std::find(list.begin(), list.end(), *one) != list.end())
      return Error{name + " stands twice", "", 0, 0, "leave one out"};
    list.push_back(std::move(*one));
    first = end + 1;
  }
  return list;
}

}  // namespace bihive::cli
