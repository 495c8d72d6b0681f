// Checks the files that a command writes: writable before its work, and none of those that it reads.
#pragma once

#include <string>
#include <vector>

#include "bihive/job/input.h"

namespace bihive::cli {

/// The path of an output; for "-" the standard output's.
std::string output_path(const std::string& output);

/// Ends the program (kBadInput) if an output cannot be written, is a file that is read, or is the file of the standard
/// output; `inputs` may contain "-", names that are not files, and empty texts. Ends it with kBadUsage if two outputs
/// are the same file, or if an output is the terminal of the standard output (unless what is written is text).
void check_outputs(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs,
                   bool are_text = false);

/// Whether one of the outputs goes to the standard output, so that a report must not.
bool on_standard_output(const std::vector<std::string>& outputs);

/// Prints the report of a command: to stdout, or to stderr if an output goes to stdout.
void print_report(const std::string& text, const std::vector<std::string>& outputs);

}  // namespace bihive::cli
