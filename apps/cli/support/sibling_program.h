// Programs that belong to bihive and are started by it: bihive-view, bihive-thesis.
#pragma once

#include <string>

namespace bihive::cli {

/// Becomes the program of this name, which lies beside this one or in the PATH of the shell; returns only by a Failure
/// (kEnvironment). `words`: its arguments, ended by a null pointer; the first is its name. `hint`: how it is built,
/// where it is not installed.
[[noreturn]] void become_program(const std::string& name, const char* const* words, const std::string& hint);

}  // namespace bihive::cli
