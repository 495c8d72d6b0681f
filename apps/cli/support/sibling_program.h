// Programs that belong to bihive and are started by it: bihive-view, bihive-thesis.
#pragma once

#include <string>

namespace bihive::cli {

/// Becomes the program of this name, which lies beside this one or in the PATH of the shell; returns only by a Failure
/// (kEnvironment). `arguments`: its argv, ended by a null pointer. `hint`: how to build it, said if it is not
/// installed.
[[noreturn]] void become_program(const std::string& name, const char* const* arguments, const std::string& hint);

}  // namespace bihive::cli
