// What an experiment has to show: tables, pictures and charts, the same for the report and for results.json.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace bihive::cli::thesis {

using Json = nlohmann::ordered_json;

/// How a value of ours compares with the thesis's. `agrees` and `differs` are coloured in the report (green, red).
enum class Verdict { none, agrees, differs };

struct Cell {
  std::string text;
  Verdict verdict = Verdict::none;
};

struct Table {
  std::string title;
  std::vector<std::string> columns;
  std::vector<std::vector<Cell>> rows;  ///< each as long as `columns`
  std::string note;                     ///< how the verdicts are made; may be empty
};

/// A file in the output folder, named relative to it ("figure-4.1/scenario1.png").
struct Illustration {
  std::string file;  ///< .png or .svg
  std::string caption;
};

struct Section {
  std::vector<std::string> paragraphs;  ///< what was done and what is seen, plain text
  std::vector<Table> tables;
  std::vector<Illustration> illustrations;
  bool pairs = false;          ///< illustrations belong together by twos: they stand side by side where there is room
  Json data = Json::object();  ///< every number of the tables and charts, for machines
};

}  // namespace bihive::cli::thesis
