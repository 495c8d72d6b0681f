#include "bihive/io/text/id_order.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "bihive/base/readable.h"

namespace bihive {

IdOrder order_of_ids(const std::vector<double>& ids) {
  IdOrder order;
  // Increasing ids, of which none is NaN: the usual case of a sorted file.
  if (ids.empty() || !std::isfinite(ids.front()) || !std::isfinite(ids.back())) return order;
  if (std::adjacent_find(ids.begin(), ids.end(), [](double a, double b) { return !(a < b); }) == ids.end()) {
    order.kind = RowIds::in_order;
    return order;
  }
  if (!std::all_of(ids.begin(), ids.end(), [](double id) { return std::isfinite(id); })) return order;

  // Sort them. Rows of the same id keep their order.
  std::vector<std::pair<double, std::int64_t>> sorted;
  sorted.reserve(ids.size());
  for (const double id : ids) sorted.emplace_back(id, static_cast<std::int64_t>(sorted.size()));
  std::sort(sorted.begin(), sorted.end());
  order.kind = RowIds::sorted;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    const auto& [id, row] = sorted[i];
    if (id != sorted[i - 1].first || (order.kind == RowIds::repeated && row > order.repeated_at)) continue;
    order.kind = RowIds::repeated;
    order.repeated_id = id;
    order.repeated_at = row;
    order.repeated_from = sorted[i - 1].second;
  }
  if (order.kind == RowIds::repeated) return order;
  order.rows.reserve(sorted.size());
  for (const auto& [id, row] : sorted) order.rows.push_back(row);
  return order;
}

void put_in_order(TextCollector& texts, const std::vector<std::int64_t>& rows) {
  TextCollector sorted;
  sorted.reserve(rows.size());
  for (const std::int64_t row : rows)
    sorted.add(texts.texts()[static_cast<std::size_t>(texts.text_of_sphere()[static_cast<std::size_t>(row)])]);
  texts = std::move(sorted);
}

void note_id_order(const IdOrder& order, const std::string& file, std::optional<std::int64_t> first_line,
                   RawSpheres& spheres) {
  spheres.ids = order.kind;
  if (order.kind == RowIds::sorted)
    spheres.rules.push_back("order: by id, as the rows of the file are in another order");
  if (order.kind != RowIds::repeated) return;
  const auto row_name = [&](std::int64_t row) {
    return first_line ? "line " + std::to_string(*first_line + row) : "row " + std::to_string(row) + " (from 0)";
  };
  const std::string at = first_line ? file + ":" + std::to_string(*first_line + order.repeated_at)
                                    : file + ": " + row_name(order.repeated_at);
  spheres.warnings.push_back(at + ": the id " + readable_number(order.repeated_id) + " stands in " +
                             row_name(order.repeated_from) +
                             " too, so ids do not say which sphere is which, and the order of the file is kept");
}

}  // namespace bihive
