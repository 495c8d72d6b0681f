#include "tree_table.h"

#include <fmt/format.h>
#include <imgui.h>

#include <nlohmann/json.hpp>

#include "bihive/base/json_text.h"
#include "theme.h"
#include "widgets.h"

namespace bihive::window {
namespace {

using nlohmann::json;

constexpr std::int64_t kQuickSpheres = 100000;

std::string grouped(const json& value) {
  return window::grouped(value.get<std::int64_t>());
}

std::string rounded(const json& value) {
  return fmt::format("{:.2f}", value.get<double>());
}

std::string milliseconds(const json& value) {
  const double ms = value.get<double>();
  return ms < 1000 ? fmt::format("{:.3g} ms", ms) : fmt::format("{:.3g} s", ms / 1000);
}

std::string percent(const json& value) {
  return fmt::format("{:.1f} %", 100 * value.get<double>());
}

void in_cell(const std::string& text) {
  const float space = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
  if (space > 0) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + space);
  ImGui::TextUnformatted(text.c_str());
}

}  // namespace

void TreeTable::update(const Viewer& viewer, bool settled) {
  const ViewerSettings& settings = viewer.settings();
  if (settings.max_prims != max_prims_ || settings.max_depth != max_depth_) current_ = false;
  if (current_ || viewer.facts().spheres == 0) return;
  if (!settled && viewer.facts().spheres > kQuickSpheres) return;
  max_prims_ = settings.max_prims;
  max_depth_ = settings.max_depth;
  current_ = true;
  read(viewer.statistics_json());
}

void TreeTable::read(const std::string& text) {
  const json tree = *json_from_text<json>(text);
  rows_.clear();
  error_ = tree.value("error", "");
  if (!error_.empty()) return;
  const json& wide = tree.at("wide");
  const double spheres = std::max(tree.at("spheres").get<double>(), 1.0);
  rows_ = {
      {"inner nodes", grouped(tree.at("inner_nodes")), grouped(wide.at("nodes"))},
      {"leaves", grouped(tree.at("leaves")), grouped(wide.at("leaves"))},
      {"spheres per leaf", rounded(tree.at("spheres_per_leaf").at("avg")),
       rounded(wide.at("spheres_per_leaf").at("avg"))},
      {"  at most", grouped(tree.at("spheres_per_leaf").at("max")), grouped(wide.at("spheres_per_leaf").at("max"))},
      {"depth", rounded(tree.at("depth").at("avg")), rounded(wide.at("nodes_above_leaf").at("avg"))},
      {"  at most", grouped(tree.at("depth").at("max")), grouped(wide.at("levels"))},
      {"clip nodes", grouped(tree.at("optimized_nodes")), ""},
      {"forced leaves", grouped(tree.at("forced_leaves")), ""},
      {"fill of nodes", "", percent(wide.at("node_fill"))},
      {"bytes", grouped(tree.at("bytes").at("total")), grouped(wide.at("bytes").at("total"))},
      {"  a sphere", rounded(tree.at("bytes").at("total").get<double>() / spheres),
       rounded(wide.at("bytes_per_sphere"))},
      {"  allocated", grouped(tree.at("allocated_bytes")), grouped(wide.at("allocated_bytes"))},
      {"build", milliseconds(tree.at("build_ms")), milliseconds(wide.at("build_ms"))},
  };
}

void TreeTable::draw() const {
  if (!error_.empty()) {
    ImGui::TextColored(kBad, "%s", error_.c_str());
    return;
  }
  if (rows_.empty() || !ImGui::BeginTable("trees", 3, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp))
    return;
  ImGui::TableSetupColumn("", 0, 1.15F);
  ImGui::TableSetupColumn("reference", 0, 1);
  ImGui::TableSetupColumn("wide", 0, 1);
  ImGui::PushStyleColor(ImGuiCol_Text, kDim);
  ImGui::TableNextRow();
  ImGui::TableSetColumnIndex(1);
  in_cell("reference");
  ImGui::TableSetColumnIndex(2);
  in_cell("wide");
  ImGui::PopStyleColor();
  for (const Row& row : rows_) {
    ImGui::TableNextRow();
    ImGui::TableSetColumnIndex(0);
    ImGui::TextColored(kDim, "%s", row.name.c_str());
    ImGui::TableSetColumnIndex(1);
    in_cell(row.reference);
    ImGui::TableSetColumnIndex(2);
    in_cell(row.wide);
  }
  ImGui::EndTable();
}

}  // namespace bihive::window
