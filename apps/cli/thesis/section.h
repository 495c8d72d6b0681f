// The output of an experiment: tables, pictures and charts, the same for the report and for results.json.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bihive/thesis/stated_values.h"

namespace bihive::cli::thesis {

using Json = nlohmann::ordered_json;

/// The verdict on a value of ours.
enum class Verdict {
  none,              ///< nothing to compare with
  agrees,            ///< with what is expected
  differs,           ///< from it
  undecided,         ///< the spread of our measurement reaches across the limit
  text_inconsistent  ///< the text contradicts itself: no value of ours could agree with all of it
};
/// For machines: "none", "agrees", "differs", "undecided", "text_inconsistent".
const char* name_of(Verdict verdict);
/// For people. Only what agrees with the text is called so: "as inferred" and "check holds" are something else.
std::string words_of(Verdict verdict, ValueKind kind);

struct Cell {
  std::string text;
  Verdict verdict = Verdict::none;
  ValueKind kind = ValueKind::stated;  ///< whose the value is that the verdict compares with
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

/// One comparison. Every verdict of a table has one: the page of verdicts and `--against` read these.
struct Finding {
  std::string name;  ///< unique in its experiment
  std::string statement, expected, ours;
  Verdict verdict;
  ValueKind kind;
  bool timed = false;  ///< it depends on the machine, so another run may find something else
};

/// Shown in this order: paragraphs, illustrations, tables, parts.
struct Section {
  std::string title;                    ///< of a part; empty for a whole experiment
  std::vector<std::string> paragraphs;  ///< method and content, plain text
  std::vector<Table> tables;
  std::vector<Illustration> illustrations;
  bool pairs = false;          ///< in pairs: two illustrations stand side by side if there is room
  Json data = Json::object();  ///< every number of the tables and charts, for machines
  std::vector<Finding> findings;
  std::vector<Section> parts;  ///< their findings stand in the whole experiment's list; they have no data

  /// Keeps the finding, and returns the cell that shows it.
  Cell judge(Finding finding, const std::string& text) {
    findings.push_back(std::move(finding));
    return {text, findings.back().verdict, findings.back().kind};
  }
};

}  // namespace bihive::cli::thesis
