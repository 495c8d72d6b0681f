#include "support/outputs.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>

#include "bihive/base/write_file.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"

namespace bihive::cli {
namespace {

// A regular file that the shell has opened for the stream, named as an output too: writing it would destroy what is
// read there, or what is printed.
bool is_file_of(int stream, const std::string& output) {
  struct stat named {};
  struct stat opened {};
  return !is_stream(output) && stat(output.c_str(), &named) == 0 && fstat(stream, &opened) == 0 &&
         S_ISREG(named.st_mode) && named.st_dev == opened.st_dev && named.st_ino == opened.st_ino;
}

}  // namespace

std::string output_path(const std::string& output) {
  return output == kStandardStream ? "/dev/stdout" : output;
}

void check_outputs(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs, bool are_text) {
  std::vector<std::string> seen;
  for (const std::string& output : outputs) {
    const std::string path = output_path(output);
    for (const std::string& input : inputs)
      if (!input.empty() && input != kStandardStream && access(input.c_str(), F_OK) == 0 && is_same_file(path, input))
        fail(
            {"is the input " + input + " too, and writing it would destroy that", output, 0, 0, "name another output"});
    if (is_file_of(STDIN_FILENO, path))
      fail({"is the file of the standard input too, and writing it would destroy that", output, 0, 0,
            "name another output"});
    for (const std::string& other : seen)
      if (is_same_file(path, output_path(other)) || (is_standard_output(path) && on_standard_output({other})))
        fail_usage("two outputs name the same file: " + other + " and " + output, "name two files");
    if (const Status status = check_writable(path); !status) fail(status.error());
    if (is_file_of(STDOUT_FILENO, path))
      fail({"is the file of the standard output too", output, 0, 0, "send the report elsewhere, or write to -"});
    if (!are_text && is_standard_output(path) && isatty(STDOUT_FILENO) != 0)
      fail_usage(output + " would write binary data to the terminal", "send it to a program or into a file");
    seen.push_back(output);
  }
}

bool on_standard_output(const std::vector<std::string>& outputs) {
  return std::any_of(outputs.begin(), outputs.end(),
                     [](const std::string& output) { return is_standard_output(output_path(output)); });
}

void print_report(const std::string& text, const std::vector<std::string>& outputs) {
  if (!on_standard_output(outputs)) return print(text);
  say_lines(text);
}

}  // namespace bihive::cli
