#include "commands/picture_bands.h"

#include <algorithm>
#include <utility>

namespace bihive::cli {

PictureBands::PictureBands(const RenderSettings& settings, int who_draw) : all_(drawn_pixels(settings)) {
  constexpr int kOfEach = 8, kLeastRows = 16, kMostRows = 64;
  rows_ = std::clamp(all_.height() / (kOfEach * who_draw), kLeastRows, kMostRows);
}

Tile PictureBands::pixels(std::int64_t number) const {
  const int y = all_.y0 + static_cast<int>(number) * rows_;
  return {all_.x0, y, all_.x1, std::min(y + rows_, all_.y1)};
}

void BandsInOrder::add(std::int64_t number, Film film) {
  early_.emplace(number, std::move(film));
  for (auto first = early_.begin(); first != early_.end() && first->first == written_; first = early_.begin()) {
    if (status_) status_ = file_.add(first->second, bands_.pixels(written_));
    early_.erase(first);
    ++written_;
  }
  progress_(static_cast<double>(written_) / static_cast<double>(bands_.count()));
}

}  // namespace bihive::cli
