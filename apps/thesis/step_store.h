// The results of steps, kept as files so that an interrupted run can go on: <out>/steps/<experiment>/<step>.json.
#pragma once

#include <optional>
#include <string>

#include "experiment.h"
#include "machine_load.h"

namespace bihive::thesis {

class StepStore {
 public:
  StepStore(std::string out, const Settings& settings) : out_(std::move(out)), settings_(settings) {}

  struct Saved {
    Json result;
    MachineLoad load;
  };
  /// The result, if the same build of the program saved it with the same settings and stated values.
  std::optional<Saved> load(const std::string& experiment, const std::string& step, const Values& values) const;
  /// Fails if the file cannot be written.
  void save(const std::string& experiment, const std::string& step, const Values& values, const Saved& saved) const;

 private:
  std::string path(const std::string& experiment, const std::string& step) const;
  Json key(const Values& values) const;

  std::string out_;
  Settings settings_;
};

}  // namespace bihive::thesis
