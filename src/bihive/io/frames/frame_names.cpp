#include "bihive/io/frames/frame_names.h"

#include <algorithm>

namespace bihive {
namespace {

// Whether the types are those that a table gives to labels: 1, 2, ... in order of appearance.
bool follow_labels(const std::vector<std::int32_t>& types, const NamedTexts& labels) {
  return std::equal(types.begin(), types.end(), labels.text_of_sphere.begin(), labels.text_of_sphere.end(),
                    [](std::int32_t type, std::int32_t label) { return type == label + 1; });
}

}  // namespace

void FrameNames::Column::add(const NamedTexts& texts) {
  for (const std::string& text : texts.texts)
    if (number_of.try_emplace(text, static_cast<std::int32_t>(names.size())).second) names.push_back(text);
}

bool FrameNames::Column::knows_all(const NamedTexts& texts) const {
  return std::all_of(texts.texts.begin(), texts.texts.end(),
                     [&](const std::string& text) { return number_of.contains(text); });
}

void FrameNames::note(const RawSpheres& spheres) {
  for (const NamedTexts& texts : spheres.attributes.texts) columns_[texts.name].add(texts);
  ++noted_;
}

bool FrameNames::knows_all(const RawSpheres& spheres) const {
  return std::all_of(spheres.attributes.texts.begin(), spheres.attributes.texts.end(), [&](const NamedTexts& texts) {
    const auto column = columns_.find(texts.name);
    return column != columns_.end() && column->second.knows_all(texts);
  });
}

void FrameNames::put_in_order(std::int64_t frame, RawSpheres& spheres, bool reads_each_apart, const ReadFrame& read) {
  if (spheres.attributes.texts.empty()) return;
  const std::lock_guard<std::mutex> lock(lock_);
  // The frames before this one, as far as it matters.
  const std::int64_t matter = reads_each_apart ? frame : std::min<std::int64_t>(frame, 1);
  while (noted_ < matter && (noted_ == 0 || !knows_all(spheres))) {
    const Result<RawSpheres> before = read(noted_);
    note(before ? *before : RawSpheres());
  }
  if (noted_ == frame && (reads_each_apart || frame == 0)) note(spheres);
  if (frame == 0) return;
  for (NamedTexts& texts : spheres.attributes.texts) {
    Column own;
    if (!reads_each_apart) own = columns_[texts.name];
    Column& column = reads_each_apart ? columns_[texts.name] : own;
    column.add(texts);  // all are known where each frame is read apart, unless the file changes
    std::vector<std::int32_t> number_of_text;
    std::int32_t last = -1;
    for (const std::string& text : texts.texts) {
      number_of_text.push_back(column.number_of.at(text));
      last = std::max(last, number_of_text.back());
    }
    if (std::is_sorted(number_of_text.begin(), number_of_text.end()) && last + 1 == std::ssize(number_of_text))
      continue;
    const bool gives_types = texts.name == "type" && follow_labels(spheres.attributes.type, texts);
    for (std::int32_t& text : texts.text_of_sphere) text = number_of_text[static_cast<std::size_t>(text)];
    texts.texts.assign(column.names.begin(), column.names.begin() + last + 1);
    if (gives_types)
      for (std::size_t i = 0; i < texts.text_of_sphere.size(); ++i)
        spheres.attributes.type[i] = texts.text_of_sphere[i] + 1;
  }
}

}  // namespace bihive
