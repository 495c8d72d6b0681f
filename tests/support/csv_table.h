// A small table of tests/data: lines of comma-separated cells; '#' starts a comment; the first line names the columns.
#pragma once

#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "bihive/base/check.h"

namespace bihive::test {

using CsvRow = std::map<std::string, std::string>;

/// The file of that name in tests/data; ends the test program if it is missing or empty.
inline std::vector<CsvRow> csv_table(const std::string& name) {
  std::ifstream file(std::string(BIHIVE_SOURCE_DIR) + "/tests/data/" + name);
  std::vector<std::string> columns;
  std::vector<CsvRow> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::vector<std::string> cells;
    std::stringstream parts(line + ",");
    for (std::string cell; std::getline(parts, cell, ',');) cells.push_back(cell);
    if (columns.empty()) {
      columns = cells;
      continue;
    }
    BIHIVE_CHECK_EQ(cells.size(), columns.size());
    CsvRow row;
    for (std::size_t i = 0; i < cells.size(); ++i) row[columns[i]] = cells[i];
    rows.push_back(row);
  }
  BIHIVE_CHECK(!rows.empty());
  return rows;
}

/// Half a unit of the last decimal in the cell: the largest effect of rounding.
inline double print_rounding(const std::string& cell) {
  const std::size_t point = cell.find('.');
  double half = 0.5;
  for (std::size_t i = point; point != std::string::npos && i + 1 < cell.size(); ++i) half /= 10;
  return half;
}

}  // namespace bihive::test
