#include "bihive/job/choose_labels.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "bihive/base/setting_name.h"
#include "bihive/image/font.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "bihive/render/draw_labels.h"
#include "bihive/scene/legend.h"

namespace bihive {
namespace {

// Removes one label if the picture cannot have it.
void check_one(bool Labels::*label, bool asked_for, std::string_view id, const Scene& scene, RenderSettings& settings) {
  RenderSettings alone = settings;
  alone.labels = {};
  alone.labels.*label = settings.labels.*label;
  const Status status = check_labels(scene, alone);
  if (status) return;
  if (asked_for) fail_setting(id, ": " + status.error().message, status.error().hint);
  warn("left out, as " + setting_name(id) + " would be: " + status.error().message);
  settings.labels.*label = false;
}

}  // namespace

std::vector<std::string> missing_letters(const Scene& scene, const Labels& labels) {
  std::vector<std::pair<std::string, std::string>> texts;  // and what they are
  if (!labels.title.empty()) texts.emplace_back("the title", labels.title);
  if (labels.scale_bar && labels.length_unit) texts.emplace_back("the scale bar", *labels.length_unit);
  if (labels.legend)
    for (const LegendKey& key : legend_of(scene)) {
      texts.emplace_back("the legend", key.title);
      for (const LegendEntry& entry : key.entries) texts.emplace_back("the legend", entry.name);
    }
  std::vector<std::pair<std::string, std::vector<char32_t>>> lacking;
  for (const auto& [what, text] : texts)
    for (const char32_t letter : characters_of(text)) {
      if (has_glyph(letter)) continue;
      if (lacking.empty() || lacking.back().first != what) lacking.emplace_back(what, std::vector<char32_t>());
      std::vector<char32_t>& letters = lacking.back().second;
      if (std::find(letters.begin(), letters.end(), letter) == letters.end()) letters.push_back(letter);
    }
  constexpr std::size_t kMostNamed = 8;
  std::vector<std::string> sentences;
  for (const auto& [what, letters] : lacking)
    sentences.push_back(what + " has boxes in place of letters that the font (DejaVu Sans) lacks: " +
                        text_of(letters, 0, std::min(letters.size(), kMostNamed)) +
                        (letters.size() > kMostNamed ? " and more" : ""));
  return sentences;
}

void leave_out_labels(const Overrides& user, const Scene& scene, RenderSettings& settings) {
  check_one(&Labels::legend, user.is_on("legend"), "legend", scene, settings);
  check_one(&Labels::scale_bar, user.is_on("scale_bar"), "scale_bar", scene, settings);
}

}  // namespace bihive
