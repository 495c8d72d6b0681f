#include "step_store.h"

#include <filesystem>
#include <utility>

#include "bihive/base/json_text.h"
#include "bihive/base/version.h"
#include "bihive/base/write_file.h"
#include "support/failure.h"

namespace bihive::thesis {
namespace fs = std::filesystem;

std::string StepStore::path(const std::string& experiment, const std::string& step) const {
  return out_ + "/steps/" + experiment + "/" + step + ".json";
}

// All data on which a result depends.
Json StepStore::key(const Values& values) const {
  return {{"version", std::string(version())}, {"commit", std::string(commit())}, {"quick", settings_.quick},
          {"threads", settings_.threads},      {"seed", settings_.seed},          {"values", values.document()}};
}

std::optional<StepStore::Saved> StepStore::load(const std::string& experiment, const std::string& step,
                                                const Values& values) const {
  // A damaged file or a file of another run counts as missing.
  const Result<std::string> bytes = read_file(path(experiment, step));
  if (!bytes) return std::nullopt;
  Result<Json> parsed = json_from_text<Json>(*bytes);
  if (!parsed) return std::nullopt;
  Json& document = *parsed;
  if (!document.is_object() || !document.contains("key") || !document.contains("result")) return std::nullopt;
  if (document["key"] != key(values) || !document.contains("load")) return std::nullopt;
  try {
    return Saved{std::move(document["result"]), nlohmann::json(document["load"]).get<MachineLoad>()};
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

void StepStore::save(const std::string& experiment, const std::string& step, const Values& values,
                     const Saved& saved) const {
  const std::string file = path(experiment, step);
  std::error_code error;
  fs::create_directories(fs::path(file).parent_path(), error);
  if (error) cli::fail({"the folder cannot be made: " + error.message(), fs::path(file).parent_path(), 0, 0, ""});
  const Json document{{"key", key(values)}, {"load", nlohmann::json(saved.load)}, {"result", saved.result}};
  if (const Status status = write_file(file, document.dump(1) + "\n"); !status) cli::fail(status.error());
}

}  // namespace bihive::thesis
