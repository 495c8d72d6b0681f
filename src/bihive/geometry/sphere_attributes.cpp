#include "bihive/geometry/sphere_attributes.h"

#include <algorithm>
#include <utility>

namespace bihive {
namespace {

template <class T>
std::int64_t bytes_of_column(const std::vector<T>& column) {
  return static_cast<std::int64_t>(column.capacity() * sizeof(T));
}

template <class Column>
const Column* column_called(const std::vector<Column>& columns, std::string_view name) {
  const auto found = std::find_if(columns.begin(), columns.end(), [name](const Column& c) { return c.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

template <class T>
std::vector<T> entries_of_part(const std::vector<T>& values, const std::vector<std::int64_t>& ids) {
  std::vector<T> made;
  if (values.empty()) return made;
  made.reserve(ids.size());
  for (const std::int64_t id : ids) made.push_back(values[static_cast<std::size_t>(id)]);
  return made;
}

// With the texts that are left alone: each sphere of the whole may have its own.
NamedTexts texts_of_part(const NamedTexts& whole, const std::vector<std::int64_t>& ids) {
  NamedTexts made{whole.name, {}, {}};
  made.text_of_sphere.reserve(ids.size());
  std::unordered_map<std::int32_t, std::int32_t> place_of;
  for (const std::int64_t id : ids) {
    const std::int32_t before = whole.text_of_sphere[static_cast<std::size_t>(id)];
    const auto [place, is_new] = place_of.emplace(before, static_cast<std::int32_t>(made.texts.size()));
    if (is_new) made.texts.push_back(whole.texts[static_cast<std::size_t>(before)]);
    made.text_of_sphere.push_back(place->second);
  }
  return made;
}

}  // namespace

void TextCollector::add(std::string_view text) {
  // Neighbouring spheres often have the same text.
  if (!text_of_sphere_.empty() && texts_[static_cast<std::size_t>(text_of_sphere_.back())] == text) {
    text_of_sphere_.push_back(text_of_sphere_.back());
    return;
  }
  text_of_sphere_.push_back(position_of(text));
}

std::int32_t TextCollector::position_of(std::string_view text) {
  // Most columns have a few texts only.
  constexpr std::size_t kFew = 8;
  for (std::size_t i = 0; i < std::min(kFew, texts_.size()); ++i)
    if (texts_[i] == text) return static_cast<std::int32_t>(i);
  const auto [entry, is_new] =
      position_of_text_.try_emplace(std::string(text), static_cast<std::int32_t>(texts_.size()));
  if (is_new) texts_.emplace_back(text);
  return entry->second;
}

void TextCollector::append(const TextCollector& other) {
  std::vector<std::int32_t> here;
  here.reserve(other.texts_.size());
  for (const std::string& text : other.texts_) here.push_back(position_of(text));
  text_of_sphere_.reserve(text_of_sphere_.size() + other.text_of_sphere_.size());
  for (const std::int32_t there : other.text_of_sphere_) text_of_sphere_.push_back(here[std::size_t(there)]);
}

void TextCollector::clear() {
  texts_.clear();
  text_of_sphere_.clear();
  position_of_text_.clear();
}

NamedTexts TextCollector::take(std::string name) {
  NamedTexts column{std::move(name), std::move(texts_), std::move(text_of_sphere_)};
  *this = {};
  return column;
}

const NamedNumbers* SphereAttributes::find_numbers(std::string_view name) const {
  return column_called(numbers, name);
}

const NamedTexts* SphereAttributes::find_texts(std::string_view name) const {
  return column_called(texts, name);
}

void SphereAttributes::keep_only(const std::vector<std::uint8_t>& kept) {
  keep_entries(element, kept);
  keep_entries(type, kept);
  keep_entries(colour, kept);
  keep_entries(opacity, kept);
  keep_entries(outline_px, kept);
  keep_entries(crease, kept);
  keep_entries(clips, kept);
  for (NamedNumbers& column : numbers) keep_entries(column.values, kept);
  for (NamedTexts& column : texts) keep_entries(column.text_of_sphere, kept);
  bonds.keep_only(kept);
}

SphereAttributes SphereAttributes::part(const std::vector<std::int64_t>& ids) const {
  SphereAttributes made;
  made.element = entries_of_part(element, ids);
  made.type = entries_of_part(type, ids);
  made.colour = entries_of_part(colour, ids);
  made.opacity = entries_of_part(opacity, ids);
  made.outline_px = entries_of_part(outline_px, ids);
  made.crease = entries_of_part(crease, ids);
  made.clips = entries_of_part(clips, ids);
  for (const NamedNumbers& column : numbers) made.numbers.push_back({column.name, entries_of_part(column.values, ids)});
  for (const NamedTexts& column : texts) made.texts.push_back(texts_of_part(column, ids));
  made.bonds = bonds.part(ids);
  return made;
}

std::int64_t SphereAttributes::allocated_bytes() const {
  std::int64_t bytes = bytes_of_column(element) + bytes_of_column(type) + bytes_of_column(colour) +
                       bytes_of_column(opacity) + bytes_of_column(outline_px) + bytes_of_column(crease) +
                       bytes_of_column(clips) + bonds.allocated_bytes();
  for (const NamedNumbers& column : numbers) bytes += bytes_of_column(column.values);
  for (const NamedTexts& column : texts) {
    bytes += bytes_of_column(column.text_of_sphere) + bytes_of_column(column.texts);
    // A short text lies inside its string; only a longer one has memory of its own.
    for (const std::string& text : column.texts)
      if (text.capacity() > std::string().capacity()) bytes += static_cast<std::int64_t>(text.capacity() + 1);
  }
  return bytes;
}

}  // namespace bihive
