// The cards of controls that window and page show beside a picture: their names, their order, and which of them has the
// controls of which parameters. tests/unit/viewer_cards_test.cpp compares the page with it.
#pragma once

#include <span>
#include <string_view>

#include "bihive/settings/parameter.h"

namespace bihive {

struct Card {
  std::string_view id;     ///< "style"
  std::string_view title;  ///< "Style"
  bool in_bar = true;      ///< has a button among the others; false: what the picture shows opens it
  bool is_second = false;  ///< in a narrow window its button is in the card "more"
};

/// In the order of their buttons.
std::span<const Card> cards();
/// Null: there is no card of that id.
const Card* card_named(std::string_view id);

/// A part of a card, with the controls of a group (settings/parameter.h).
struct CardSection {
  std::string_view card;   ///< id
  std::string_view title;  ///< "Light"
  ParameterGroup group;
};

/// In the order in which a card shows them.
std::span<const CardSection> card_sections();

}  // namespace bihive
