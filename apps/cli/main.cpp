// bihive, the program: parses the command line, runs the sub-command, and turns failures into exit codes.

#include <cstdio>
#include <exception>
#include <new>
#include <stdexcept>
#include <variant>

#include "bihive/simd/target.h"
#include "command_line.h"
#include "support/failure.h"
#include "support/interrupt.h"
#include "support/messages.h"

namespace bihive::cli {
namespace {

// One call for each kind of request.
struct Run {
  int operator()(const HelpText& help) const {
    if (help.asked_for) {
      print(help.text);
      return kSuccess;
    }
    std::fputs(help.text.c_str(), stderr);
    return kBadUsage;
  }
  int operator()(const RenderOptions& options) const { return run_render(options), kSuccess; }
  int operator()(const ViewOptions& options) const { run_view(options); }
  int operator()(const StatsOptions& options) const { return run_stats(options), kSuccess; }
  int operator()(const TraceOptions& options) const { return run_trace(options), kSuccess; }
  int operator()(const SceneOptions& options) const { return run_scene(options), kSuccess; }
  int operator()(const InfoOptions& options) const { return run_info(options), kSuccess; }
  int operator()(const StylesOptions& options) const { return run_styles(options), kSuccess; }
  int operator()(const SelectOptions& options) const { return run_select(options), kSuccess; }
  int operator()(const ThesisOptions& options) const { return run_thesis(options), kSuccess; }
  int operator()(const WebOptions& options) const { return run_web(options), kSuccess; }
};

int run(int argc, const char* const* argv) {
  try {
    handle_signals();
    if (const Status status = check_target_environment(); !status) throw Failure{kBadUsage, status.error()};
    const int code = std::visit(Run{}, parse_command_line(argc, argv));
    finish_output();
    return code;
  } catch (const Failure& failure) {
    say_error(failure.error.to_string());
    std::fputs(failure.shown.c_str(), stderr);
    return failure.code;
  } catch (const std::bad_alloc&) {
    say_error("not enough memory");
  } catch (const std::length_error&) {
    say_error("not enough memory");
  } catch (const std::exception& error) {
    say_error(error.what());
  }
  return kBadInput;
}

}  // namespace
}  // namespace bihive::cli

int main(int argc, char** argv) {
  return bihive::cli::run(argc, argv);
}
