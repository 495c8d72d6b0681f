#include "bihive/viewer/pacing.h"

#include <algorithm>
#include <cstdint>

namespace bihive {
namespace {

constexpr int kDivisors[] = {1, 2, 3, 4, 6, 8, 12, kCoarsestDivisor};
// Up to this divisor the pixels are hardly visible in motion.
constexpr int kFineDivisor = 3;
constexpr double kWindowMs = 1000;

double cost_of(PictureStep step) {
  return static_cast<double>(step.samples) / (static_cast<double>(step.divisor) * step.divisor);
}

}  // namespace

int divisor_for(int width_px, int height_px, const PictureCost& cost, double budget_ms) {
  for (const int divisor : kDivisors) {
    const std::int64_t pixels = std::int64_t{divided(width_px, divisor)} * divided(height_px, divisor);
    const double allowed_ms = divisor <= kFineDivisor ? budget_ms : 2 * std::max(budget_ms, cost.fixed_ms());
    if (cost.ms_for(pixels) <= allowed_ms) return divisor;
  }
  return kCoarsestDivisor;
}

PictureStep finer_step(PictureStep step, int samples_per_pixel) {
  if (step.divisor > 4) return {4, 1};
  if (step.divisor > 2) return {2, 1};
  if (step.divisor > 1) return {1, 1};
  return {1, samples_per_pixel};
}

StepShare share_of_step(PictureStep step, int samples_per_pixel) {
  // Counts as if every picture had begun at the coarsest step.
  const PictureStep last{1, samples_per_pixel};
  const PictureStep next = finer_step(step, samples_per_pixel);
  double before = 0, before_next = 0, all = 0;
  for (PictureStep one{kCoarsestDivisor, 1};; one = finer_step(one, samples_per_pixel)) {
    if (cost_of(one) < cost_of(step)) before += cost_of(one);
    if (cost_of(one) < cost_of(next)) before_next += cost_of(one);
    all += cost_of(one);
    if (one == last) break;
  }
  const double end = step == last ? all : before_next;
  return {before / all, (end - before) / all};
}

void FrameRate::moved(double now_ms) {
  times_ms_.push_back(now_ms);
  while (now_ms - times_ms_.front() > kWindowMs) times_ms_.pop_front();
}

double FrameRate::fps() const {
  if (times_ms_.size() < 2 || !(times_ms_.back() > times_ms_.front())) return 0;
  return 1000 * static_cast<double>(times_ms_.size() - 1) / (times_ms_.back() - times_ms_.front());
}

}  // namespace bihive
