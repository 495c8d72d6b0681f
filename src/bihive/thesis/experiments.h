// The experiments of the thesis and the sections of its chapter of results, in the order of the report. The command
// line, the report, the build (CMakeLists.txt) and scripts/thesis_map read these rows.
//
// An experiment's name in code is that of its function in apps/thesis; its id is its folder in thesis/.
#pragma once

// clang-format off

/// row(name in code, id, section, title)
#define BIHIVE_THESIS_EXPERIMENTS(row)                                                \
  row(figure_4_1, "figure-4.1", "B", "Figure 4.1: the three scenarios")               \
  row(figure_4_2, "figure-4.2", "C", "Figure 4.2: recursion depth")                   \
  row(figure_4_3, "figure-4.3", "D", "Figure 4.3: the tree and its traversal")        \
  row(section_d, "section-d", "D", "Section D: one leaf, and a leaf for each sphere") \
  row(table_4_2, "table-4.2", "E", "Table 4.2: statistics of the trees")              \
  row(figure_4_4, "figure-4.4", "F", "Figure 4.4: frames per second")                 \
  row(figure_4_5, "figure-4.5", "G", "Figure 4.5: memory")

/// row(letter, title)
#define BIHIVE_THESIS_SECTIONS(row) \
  row("B", "Setup")                 \
  row("C", "Visual quality")        \
  row("D", "Parameters of the tree") \
  row("E", "Statistics of trees")   \
  row("F", "Performance")           \
  row("G", "Memory")

// clang-format on
