// The cards of window and page: the page's document has those of the table, in its order.
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "bihive/viewer/cards.h"

namespace bihive {
namespace {

std::string document() {
  std::ifstream file(BIHIVE_SOURCE_DIR "/web/index.html");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// The matches of a pattern: one string per group.
std::vector<std::vector<std::string>> all(const std::string& text, const std::string& pattern) {
  std::vector<std::vector<std::string>> found;
  const std::regex expression(pattern);
  for (std::sregex_iterator at(text.begin(), text.end(), expression), end; at != end; ++at)
    found.emplace_back(at->begin() + 1, at->end());
  return found;
}

std::string name_of_group(ParameterGroup group) {
  switch (group) {
    case ParameterGroup::picture:
      return "picture";
    case ParameterGroup::light:
      return "light";
    case ParameterGroup::lines:
      return "lines";
    case ParameterGroup::tone:
      return "tone";
    case ParameterGroup::labels:
      return "labels";
    case ParameterGroup::cell:
      return "cell";
  }
  return "";
}

TEST(Cards, the_page_has_their_buttons_in_their_order) {
  const std::string text = document();
  const std::size_t begin = text.find("<div id=\"bar\"");
  ASSERT_NE(begin, std::string::npos);
  const std::string bar = text.substr(begin, text.find("</nav>", begin) - begin);
  const auto buttons = all(bar, R"re(data-card="(\w+)"( class="second")?[^>]*>([^<]+)<)re");
  std::size_t next = 0;
  for (const Card& card : cards()) {
    if (!card.in_bar) continue;
    ASSERT_LT(next, buttons.size()) << card.id;
    EXPECT_EQ(buttons[next][0], card.id);
    EXPECT_EQ(!buttons[next][1].empty(), card.is_second) << card.id;
    EXPECT_EQ(buttons[next][2], card.title);
    ++next;
  }
  EXPECT_EQ(next, buttons.size());
  EXPECT_NE(text.find("data-card=\"scene\" data-title=\"" + std::string(card_named("scene")->title) + "\""),
            std::string::npos);
}

TEST(Cards, the_page_has_their_sections_in_their_order) {
  // Cards, headings and groups of controls, as they come.
  std::vector<std::pair<std::string, std::string>> of_page;
  std::vector<std::string> titles;
  std::string card, title;
  for (const auto& found : all(document(), R"re(id="card_(\w+)"|<h3[^>]*>([^<]+)</h3>|data-parameters="(\w+)")re")) {
    if (!found[0].empty()) card = found[0];
    if (!found[1].empty()) title = found[1];
    if (found[2].empty()) continue;
    of_page.emplace_back(card, found[2]);
    titles.push_back(title);
  }
  ASSERT_EQ(of_page.size(), card_sections().size());
  for (std::size_t i = 0; i < of_page.size(); ++i) {
    const CardSection& section = card_sections()[i];
    EXPECT_EQ(of_page[i], std::make_pair(std::string(section.card), name_of_group(section.group)));
    EXPECT_EQ(titles[i], section.title);
  }
}

TEST(Cards, every_control_has_a_section) {
  std::set<ParameterGroup> groups;
  for (const CardSection& section : card_sections()) {
    EXPECT_NE(card_named(section.card), nullptr) << section.card;
    EXPECT_TRUE(groups.insert(section.group).second) << section.title;
  }
  for (const Parameter& parameter : picture_parameters())
    if (parameter.in_window && !parameter.label.empty()) {
      EXPECT_TRUE(groups.count(parameter.group)) << parameter.id;
    }
  EXPECT_EQ(card_named("nothing"), nullptr);
}

}  // namespace
}  // namespace bihive
