// Twin of scene/faint_level.h. Sets of directions or points follow each other in their texture, level after level.
#include "common"

const int kFaintLevels = 5;
const int kFewestOfFaint = 8;

int faint_level(float share) {
  int level = 0;
  for (float limit = 0.5; level < kFaintLevels - 1 && share <= limit; limit *= 0.5) ++level;
  return level;
}

int asked_at_level(int count, int level) {
  return min(count, max(kFewestOfFaint, count >> level));
}

// The index of a set's first entry; `sets` of each level.
int first_at_level(int count, int sets, int set, int level) {
  int first = set * asked_at_level(count, level);
  for (int i = 0; i < level; ++i) first += sets * asked_at_level(count, i);
  return first;
}
