// Twin of scene/faint_level.h. Sets of directions or points follow each other in their texture, level after level.
#include "common"

const int kFaintLevels = 6;
const int kFewestDirections = 2;
const int kFewestLightPoints = 1;

int faint_level(float share) {
  int level = 0;
  for (float limit = 0.70710678; level < kFaintLevels - 1 && share <= limit; limit *= 0.5) ++level;
  return level;
}

int used_at_level(int count, int level, int fewest) {
  return min(count, max(fewest, count >> level));
}

// The index of a set's first entry; `sets` of each level.
int first_at_level(int count, int sets, int set, int level, int fewest) {
  int first = set * used_at_level(count, level, fewest);
  for (int i = 0; i < level; ++i) first += sets * used_at_level(count, i, fewest);
  return first;
}
