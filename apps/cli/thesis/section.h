// The output of an experiment: tables, pictures and charts, the same for the report and for results.json.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace bihive::cli::thesis {

using Json = nlohmann::ordered_json;

/// The verdict on a value of ours. The report colours `agrees` green and `differs` red.
enum class Verdict { none, agrees, differs };

struct Cell {
  std::string text;
  Verdict verdict = Verdict::none;
};

struct Table {
  std::string title;
  std::vector<std::string> columns;
  std::vector<std::vector<Cell>> rows;  ///< each as long as `columns`
  std::string note;                     ///< the rule of the verdicts; may be empty
};

/// A file in the output folder, named relative to it ("figure-4.1/scenario1.png").
struct Illustration {
  std::string file;  ///< .png or .svg
  std::string caption;
};

struct Section {
  std::vector<std::string> paragraphs;  ///< method and content, plain text
  std::vector<Table> tables;
  std::vector<Illustration> illustrations;
  bool pairs = false;          ///< in pairs: two illustrations stand side by side if there is room
  Json data = Json::object();  ///< every number of the tables and charts, for machines
};

}  // namespace bihive::cli::thesis
