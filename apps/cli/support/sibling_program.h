// Programs that belong to bihive and are started by it: bihive-view, bihive-thesis.
#pragma once

#include <string>

namespace bihive::cli {

/// Becomes the program of this name, beside this one or in the shell's PATH; returns only by a Failure (kEnvironment).
/// `arguments`: its argv, ended by a null pointer. `hint`: how to build it, shown if it is not installed.
[[noreturn]] void become_program(const std::string& name, const char* const* arguments, const std::string& hint);

}  // namespace bihive::cli
