#include "bihive/viewer/cards.h"

#include <array>

namespace bihive {
namespace {

constexpr std::array kCards{
    Card{.id = "scene", .title = "What this is", .in_bar = false},
    Card{.id = "open", .title = "Open"},
    Card{.id = "style", .title = "Style"},
    Card{.id = "colour", .title = "Colour"},
    Card{.id = "show", .title = "Show"},
    Card{.id = "cut", .title = "Cut", .is_second = true},
    Card{.id = "measure", .title = "Measure", .is_second = true},
    Card{.id = "save", .title = "Save", .is_second = true},
    Card{.id = "share", .title = "Share", .is_second = true},
    Card{.id = "more", .title = "More"},
};

constexpr std::array kSections{
    CardSection{"style", "Light", ParameterGroup::light},   CardSection{"style", "Lines", ParameterGroup::lines},
    CardSection{"style", "Labels", ParameterGroup::labels}, CardSection{"style", "Cell", ParameterGroup::cell},
    CardSection{"more", "Lens", ParameterGroup::tone},      CardSection{"more", "Picture", ParameterGroup::picture},
};

}  // namespace

std::span<const Card> cards() {
  return kCards;
}

const Card* card_named(std::string_view id) {
  for (const Card& card : kCards)
    if (card.id == id) return &card;
  return nullptr;
}

std::span<const CardSection> card_sections() {
  return kSections;
}

}  // namespace bihive
