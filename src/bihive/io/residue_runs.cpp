#include "bihive/io/residue_runs.h"

namespace bihive {

std::vector<std::int32_t> residue_runs(const SphereAttributes& attributes, std::size_t count,
                                       const std::function<double(std::size_t)>& number) {
  std::vector<const NamedTexts*> texts;
  for (const char* const name : {"chain", "entity", "insertion", "resname"})
    if (const NamedTexts* const column = attributes.find_texts(name)) texts.push_back(column);
  const auto same_residue = [&](std::size_t i) {
    for (const NamedTexts* const column : texts)
      if (column->text_of_sphere[i] != column->text_of_sphere[i - 1]) return false;
    return number(i) == number(i - 1);
  };
  std::vector<std::int32_t> residues(count);
  for (std::size_t i = 1; i < count; ++i) residues[i] = residues[i - 1] + (same_residue(i) ? 0 : 1);
  return residues;
}

}  // namespace bihive
