// The search of a tree's parameters under a Watch: progress, and an end in between.
#include <gtest/gtest.h>

#include <vector>

#include "bihive/base/cancel.h"
#include "bihive/base/watch.h"
#include "bihive/compare/tune.h"
#include "bihive/scene/generators.h"

namespace bihive::workbench {
namespace {

Scene scene() {
  ScenarioParameters parameters;
  parameters.count = 512;
  return *scenario_scene(Scenario::corners, parameters);
}

TuneOptions quick() {
  TuneOptions options;
  options.kinds = {QueryKind::primary};
  options.count = 64;
  options.most_ms = 50;
  return options;
}

TEST(Tune, progress_rises_to_the_end) {
  TuneOptions options = quick();
  std::vector<double> shares;
  options.progress = [&](double done) { shares.push_back(done); };
  ASSERT_TRUE(tune_structure(scene(), options));
  ASSERT_GT(shares.size(), 10u) << "builds and rounds";
  for (std::size_t i = 1; i < shares.size(); ++i) EXPECT_GE(shares[i], shares[i - 1]);
  EXPECT_EQ(shares.back(), 1);
}

TEST(Tune, it_ends_when_it_is_cancelled) {
  // In the builds, and in the rounds.
  for (const double when : {0.0, 0.1, 0.5}) {
    CancelToken stop;
    TuneOptions options = quick();
    options.most_ms = 60000;
    options.count = 4096;
    options.progress = [&](double done) {
      if (done >= when) stop.cancel();
      EXPECT_LT(done, 1) << "it went on";
    };
    const Watch watch({}, &stop);
    const Result<Tuning> tuning = tune_structure(scene(), options);
    ASSERT_FALSE(tuning) << when;
    EXPECT_TRUE(is_cancelled(tuning.error())) << when;
  }
}

}  // namespace
}  // namespace bihive::workbench
