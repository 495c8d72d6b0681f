#include "colour_ranges.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "bihive/base/json_text.h"
#include "bihive/base/parse_number.h"
#include "bihive/viewer/contents.h"
#include "theme.h"

namespace bihive::window {
namespace {

constexpr int kBars = 48;

}  // namespace

void ColourRanges::update(const SphereSet& spheres, const std::string& attribute) {
  if (attribute == attribute_) return;
  attribute_ = attribute;
  heights_.clear();
  if (attribute.empty()) return;
  const Result<std::string> text = histogram_to_json(spheres, attribute, kBars);
  if (!text) return;
  const auto json = *json_from_text<nlohmann::json>(*text);
  least_ = json.at("least").get<double>(), most_ = json.at("most").get<double>();
  if (!(least_ < most_)) return;
  // By square roots, so that a few spheres are seen beside thousands.
  for (const nlohmann::json& count : json.at("counts")) heights_.push_back(std::sqrt(count.get<float>()));
}

bool ColourRanges::draw(const std::string& attribute, std::string& range) {
  if (attribute != attribute_ || heights_.empty()) return false;
  const float width = ImGui::GetContentRegionAvail().x, height = 3 * ImGui::GetTextLineHeight();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton("##histogram", {width, height});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float bar = width / static_cast<float>(heights_.size());
  const float tallest = *std::max_element(heights_.begin(), heights_.end());
  for (std::size_t i = 0; i < heights_.size(); ++i) {
    const float x = corner.x + bar * static_cast<float>(i), top = height * heights_[i] / tallest;
    list.AddRectFilled({x, corner.y + height - top}, {x + bar - 1, corner.y + height}, ImGui::GetColorU32(kDim));
  }
  const std::vector<double> given = numbers_from_text(range);
  double ends[2] = {least_, most_};
  if (given.size() == 2) ends[0] = given[0], ends[1] = given[1];
  const auto x_of = [&](double value) {
    return corner.x + width * static_cast<float>(std::clamp((value - least_) / (most_ - least_), 0.0, 1.0));
  };
  for (const double end : ends)
    list.AddLine({x_of(end), corner.y}, {x_of(end), corner.y + height}, ImGui::GetColorU32(kAccent), 2);
  if (!ImGui::IsItemActive()) {
    dragged_ = -1;
    return false;
  }

  // The end that is nearer to where the drag began follows the pointer.
  const float x = ImGui::GetMousePos().x;
  if (dragged_ < 0) dragged_ = std::abs(x - x_of(ends[0])) < std::abs(x - x_of(ends[1])) ? 0 : 1;
  const double share = std::clamp(static_cast<double>((x - corner.x) / width), 0.0, 1.0);
  ends[dragged_] = least_ + share * (most_ - least_);
  const std::string wanted = fmt::format("{:.4g},{:.4g}", ends[0], ends[1]);
  if (!(ends[0] < ends[1]) || wanted == range) return false;
  range = wanted;
  return true;
}

}  // namespace bihive::window
