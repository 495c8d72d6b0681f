#include "bihive/viewer/history.h"

#include <algorithm>
#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "bihive/base/json_text.h"
#include "bihive/settings/parameter.h"
#include "bihive/viewer/viewer_json.h"

namespace bihive {
namespace {

using nlohmann::json;

constexpr std::size_t kMostStates = 200;
constexpr double kOneChangeMs = 1000;
constexpr double kLongAgo = -std::numeric_limits<double>::infinity();

// Members whose ids say little.
constexpr std::array<std::pair<const char*, const char*>, 11> kTellingNames{{
    {"reading", "how the file is read"},
    {"replicate", "copies"},
    {"focus_on", "focus"},
    {"element_colours", "colours of elements"},
    {"colour_by", "colours"},
    {"nan_colour", "colour of unknown numbers"},
    {"crease", "lines between"},
    {"rows", "looks of selections"},
    {"rows.clip", "cut"},
    {"rows.hide", "what is hidden"},
    {"rows.colour", "colours of selections"},
}};

std::string name_of_member(const std::string& whole) {
  const std::string member = whole.substr(0, whole.find('.'));
  for (const std::string& wanted : {whole, member})
    for (const auto& [id, name] : kTellingNames)
      if (wanted == id) return name;
  const Parameter* parameter = parameter_named(member);
  if (parameter != nullptr && !parameter->long_label.empty()) return std::string(parameter->long_label);
  if (parameter != nullptr && !parameter->label.empty()) return std::string(parameter->label);
  std::string words = member;
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

// Members that differ. "set" follows from the others.
std::vector<std::string> differing(const std::string& a, const std::string& b) {
  if (a == b) return {};
  std::vector<std::string> members;
  const json one = *json_from_text<json>(a), other = *json_from_text<json>(b);
  for (const auto& [key, value] : one.items())
    if (key != "set" && value != other.value(key, json())) members.push_back(key);
  return members;
}

// "rows.clip" where no other action's rows differ.
std::string rows_member(const std::vector<LookRow>& a, const std::vector<LookRow>& b) {
  std::set<std::string> actions, differ;
  for (const std::vector<LookRow>* rows : {&a, &b})
    for (const LookRow& row : *rows) actions.insert(row.action);
  for (const std::string& action : actions) {
    const auto of_action = [&](std::vector<LookRow> rows) {
      std::erase_if(rows, [&](const LookRow& row) { return row.action != action; });
      return rows;
    };
    if (!(of_action(a) == of_action(b))) differ.insert(action);
  }
  return differ.size() == 1 ? "rows." + *differ.begin() : "rows";
}

}  // namespace

History::Entry History::entry_of(const ShownState& state) {
  return {state, reading_to_json(state.reading), settings_to_json(state.settings), viewer_look_to_json(state.look)};
}

// Only the most informative differences: reading the file differently also changes the look, and a new style also
// changes settings.
std::vector<std::string> History::changed_members(const Entry& a, const Entry& b) {
  if (a.reading != b.reading) return {"reading"};
  std::vector<std::string> looks = differing(a.look, b.look);
  for (std::string& member : looks)
    if (member == "rows") member = rows_member(a.state.look.rows, b.state.look.rows);
  return looks.empty() ? differing(a.settings, b.settings) : looks;
}

const History::Entry* History::entry_at(int by) const {
  const auto at = static_cast<std::ptrdiff_t>(at_) + by;
  return at < 0 || at >= std::ssize(entries_) ? nullptr : &entries_[static_cast<std::size_t>(at)];
}

void History::begin(const ShownState& state) {
  entries_ = {entry_of(state)};
  at_ = 0;
  last_change_.clear();
  last_ms_ = kLongAgo;
}

void History::note(const ShownState& state, bool by_user, double now_ms) {
  if (entries_.empty()) return begin(state);
  Entry entry = entry_of(state);
  const std::vector<std::string> members = changed_members(entries_[at_], entry);
  if (members.empty()) return;
  const bool goes_on = members == last_change_ && now_ms - last_ms_ < kOneChangeMs && at_ > 0;
  if (by_user && !goes_on) {
    entries_.resize(at_ + 1);
    entries_.push_back(std::move(entry));
    if (entries_.size() > kMostStates) entries_.erase(entries_.begin());
    at_ = entries_.size() - 1;
  } else {
    entries_[at_] = std::move(entry);
  }
  if (!by_user) return;
  last_change_ = members;
  last_ms_ = now_ms;
}

std::string History::next(int by) const {
  const Entry *const now = entry_at(0), *const other = entry_at(by);
  if (now == nullptr || other == nullptr) return "";
  const std::vector<std::string> members = changed_members(*now, *other);
  std::string words;
  for (std::size_t i = 0; i < std::min<std::size_t>(members.size(), 2); ++i)
    words += (i == 0 ? "" : ", ") + name_of_member(members[i]);
  return members.size() > 2 ? words + " and more" : words;
}

const ShownState* History::go(int by) {
  if (entry_at(by) == nullptr) return nullptr;
  at_ = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(at_) + by);
  last_ms_ = kLongAgo;
  return &entries_[at_].state;
}

}  // namespace bihive
