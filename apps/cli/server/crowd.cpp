#include "server/crowd.h"

#include <algorithm>

namespace bihive::cli {

std::size_t Crowd::size() const {
  std::size_t sum = 0;
  for (const auto& group : groups_) sum += group.size();
  return sum;
}

void Crowd::move(Member& member, Group group) {
  leave(member);
  member.group_ = group;
  member.position_ = groups_[group].insert(groups_[group].end(), &member);
}

void Crowd::leave(Member& member) {
  if (member.group_) groups_[*member.group_].erase(member.position_);
  member.group_.reset();
}

bool Crowd::drop_one() {
  const auto largest = std::max_element(groups_.begin(), groups_.end(),
                                        [](const auto& a, const auto& b) { return a.size() < b.size(); });
  if (largest->empty()) return false;
  Member& longest = *largest->front();
  leave(longest);
  longest.drop();
  return true;
}

}  // namespace bihive::cli
