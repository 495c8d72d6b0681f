// Structures of bihive.h, compared and tuned.
#include <cstdlib>
#include <cstring>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "bihive.h"
#include "bihive/base/parse_number.h"
#include "bihive/compare/comparison.h"
#include "bihive/compare/comparison_json.h"
#include "bihive/compare/tune.h"
#include "c_errors.h"
#include "c_progress.h"
#include "c_tree.h"

namespace bihive::c {
namespace {

// NULL: none.
std::vector<std::string> names_of(const char* text) {
  std::vector<std::string> names;
  if (text == nullptr) return names;
  for (const std::string_view name : parts_of(text, ',')) names.emplace_back(name);
  return names;
}

char* copied(const std::string& text) {
  auto* const copy = static_cast<char*>(std::malloc(text.size() + 1));
  if (copy == nullptr) throw std::bad_alloc();
  std::memcpy(copy, text.c_str(), text.size() + 1);
  return copy;
}

// Checks what both functions share, fills `options`, and stores what text_of(scene, options) returns.
template <class Options, class TextOf>
int measuring_structures(const bihive_tree* tree, const char* rays, std::int64_t count, int threads, char** json,
                         Options options, const TextOf& text_of) {
  if (json == nullptr) return failed("there is no place for the text");
  *json = nullptr;
  return guarded([&] {
    if (tree == nullptr) return failed("the tree is NULL");
    if (tree->images) return failed("structures are built from the stored spheres: take a tree without a cell");
    if (tree->spheres.empty()) return failed("there is no sphere");
    if (threads < 0) return failed("the number of threads is negative; 0 takes all");
    if (count < 1 || count > std::int64_t{1} << 30) return failed("the number of queries must be 1 to 1073741824");
    const auto kinds = workbench::query_kinds_named(names_of(rays));
    if (!kinds) return failed(kinds.error());
    options.kinds = *kinds;
    options.count = count;
    const Progress progress = progress_of_thread();
    if (progress.report != nullptr)
      options.progress = [progress](double done) {
        if (progress.report(done, progress.context) != 0) throw Cancelled{};
      };
    Scene scene;
    scene.spheres = tree->spheres;
    workbench::complete_for_queries(scene, /*has_camera=*/false, /*has_lights=*/false);
    try {
      const Result<std::string> text = text_of(scene, options);
      if (!text) return failed(text.error());
      *json = copied(*text);
    } catch (const Cancelled&) {
      return failed(cancelled_error());
    }
    return kDone;
  });
}

}  // namespace
}  // namespace bihive::c

using namespace bihive;     // NOLINT(google-build-using-namespace): the functions below are C's
using namespace bihive::c;  // NOLINT(google-build-using-namespace)

int bihive_compare(const bihive_tree* tree, const char* structures, const char* rays, int64_t count, int threads,
                   char** json) {
  workbench::ComparisonOptions options;
  options.structures = names_of(structures);
  options.threads = {threads};
  return measuring_structures(tree, rays, count, threads, json, options,
                              [](const Scene& scene, const auto& chosen) -> Result<std::string> {
                                const auto made = workbench::compare_structures(scene, chosen);
                                if (!made) return made.error();
                                return workbench::comparison_json(*made, scene.name);
                              });
}

int bihive_tune(const bihive_tree* tree, const char* structure, const char* rays, int64_t count, int threads,
                char** json) {
  workbench::TuneOptions options;
  if (structure != nullptr) options.structure = structure;
  options.threads = threads;
  return measuring_structures(tree, rays, count, threads, json, options,
                              [](const Scene& scene, const auto& chosen) -> Result<std::string> {
                                const auto made = workbench::tune_structure(scene, chosen);
                                if (!made) return made.error();
                                return workbench::tuning_json(*made, scene.name);
                              });
}

void bihive_text_free(char* text) {
  std::free(text);
}
