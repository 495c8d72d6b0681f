// bihive-bench: times the wide engine on one input, optionally beside Embree.

#include <cstdio>
#include <exception>
#include <new>

#include "bench_scene.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "bihive/simd/target.h"
#include "measure.h"
#include "options.h"
#include "report.h"

namespace bihive::bench {
namespace {

int run(int argc, const char* const* argv) {
  try {
    name_settings_as_options();
    const ParsedOptions parsed = parse_options(argc, argv);
    if (parsed.text) {
      print(*parsed.text);
      finish_output();
      return kSuccess;
    }
    const BenchOptions& options = parsed.options;
    Status status = options.target.empty() ? check_target_environment() : use_target(options.target);
    if (!status) fail_usage(status.error().message, status.error().hint);
    const BenchScene scene = load_bench_scene(options);
    const Measured measured = measure(scene, options);
    print(options.json ? json_report(measured, options) : text_report(measured, options));
    finish_output();
    return kSuccess;
  } catch (const Failure& failure) {
    say_error(failure.error.to_string());
    return failure.code;
  } catch (const std::bad_alloc&) {
    say_error("not enough memory");
  } catch (const std::exception& error) {
    say_error(error.what());
  }
  return kBadInput;
}

}  // namespace
}  // namespace bihive::bench

int main(int argc, char** argv) {
  return bihive::bench::run(argc, argv);
}
