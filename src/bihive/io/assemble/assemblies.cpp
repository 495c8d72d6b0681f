#include "bihive/io/assemble/assemblies.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "bihive/base/memory.h"
#include "bihive/base/parse_number.h"
#include "bihive/base/setting_name.h"
#include "bihive/io/raw_spheres.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

constexpr std::size_t kMostOperators = 100000;
// Coordinates, radius, element and a handful of columns.
constexpr double kBytesPerCopiedSphere = 160;

using Matrix = std::array<double, 12>;

// First b, then a.
Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 4; ++column) {
      double sum = column == 3 ? a[4 * row + 3] : 0;
      for (std::size_t i = 0; i < 3; ++i) sum += a[4 * row + i] * b[4 * i + column];
      c[4 * row + column] = sum;
    }
  return c;
}

// Turns an expression of operators into matrices.
class OperatorExpression {
 public:
  OperatorExpression(const std::vector<AssemblyOperator>& known, const std::string& file) : file_(file) {
    for (const AssemblyOperator& one : known) known_.emplace(one.id, &one.rows);
  }

  Result<std::vector<Matrix>> matrices(const std::string& expression) const {
    // Without brackets it is one group, with them a product of groups.
    std::vector<std::string> groups;
    const std::string text(trim(expression));
    if (text.find('(') == std::string::npos) groups.push_back(text);
    for (std::size_t at = 0; at < text.size() && text.find('(') != std::string::npos;) {
      const std::size_t open = text.find('(', at);
      const std::size_t close = text.find(')', at);
      if (open == std::string::npos && trim(std::string_view(text).substr(at)).empty()) break;
      if (open == std::string::npos || close == std::string::npos || close < open) return fault(expression);
      groups.push_back(text.substr(open + 1, close - open - 1));
      at = close + 1;
    }
    std::vector<Matrix> made{{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}};
    for (const std::string& group : groups) {
      const Result<std::vector<Matrix>> factors = matrices_of_group(group);
      if (!factors) return factors.error();
      if (made.size() * factors->size() > kMostOperators) return too_many();
      std::vector<Matrix> products;
      for (const Matrix& before : made)
        for (const Matrix& factor : *factors) products.push_back(product(before, factor));
      made = std::move(products);
    }
    return made;
  }

 private:
  // "1,3-5,P"
  Result<std::vector<Matrix>> matrices_of_group(const std::string& group) const {
    std::vector<Matrix> made;
    for (std::size_t begin = 0; begin <= group.size();) {
      const std::size_t end = std::min(group.find(',', begin), group.size());
      const std::string item(trim(std::string_view(group).substr(begin, end - begin)));
      begin = end + 1;
      const std::size_t dash = item.find('-');
      const auto first = parse_int(std::string_view(item).substr(0, dash));
      const auto last = dash == std::string::npos ? first : parse_int(std::string_view(item).substr(dash + 1));
      const bool is_range = dash != std::string::npos && first && last && known_.count(item) == 0;
      if (is_range && (*last < *first || *last - *first >= std::int64_t{kMostOperators})) return too_many();
      for (std::int64_t i = is_range ? *first : 0; i <= (is_range ? *last : 0); ++i) {
        const auto found = known_.find(is_range ? std::to_string(i) : item);
        if (found == known_.end())
          return Error{"there is no operator " + quote(is_range ? std::to_string(i) : item) + " for this assembly",
                       file_, 0, 0, ""};
        for (const double number : *found->second)
          if (!std::isfinite(number))
            return Error{"the operator " + quote(found->first) + " of this assembly lacks a number", file_, 0, 0, ""};
        made.push_back(*found->second);
      }
    }
    return made;
  }

  Error fault(const std::string& expression) const {
    return {"the operators of this assembly cannot be read: " + quote(expression), file_, 0, 0, ""};
  }
  Error too_many() const { return {"this assembly has too many operators", file_, 0, 0, "at most 100000 are applied"}; }

  const std::string& file_;
  std::unordered_map<std::string, const Matrix*> known_;
};

// The column by which parts name their chains.
const NamedTexts* chain_column(const SphereAttributes& attributes) {
  const NamedTexts* const column = attributes.find_texts(kAssemblyChains);
  return column != nullptr ? column : attributes.find_texts("chain");
}

template <class T>
void copy_column(std::vector<T>& column, const std::vector<std::size_t>& from) {
  if (column.empty()) return;
  std::vector<T> copied;
  copied.reserve(from.size());
  for (const std::size_t i : from) copied.push_back(column[i]);
  column = std::move(copied);
}

void copy_attributes(SphereAttributes& attributes, const std::vector<std::size_t>& from) {
  copy_column(attributes.element, from);
  copy_column(attributes.type, from);
  copy_column(attributes.colour, from);
  copy_column(attributes.opacity, from);
  for (NamedNumbers& column : attributes.numbers) copy_column(column.values, from);
  for (NamedTexts& column : attributes.texts) copy_column(column.text_of_sphere, from);
}

// The copies so far: where each comes from, and where it is. Bonds join spheres of one copy.
struct Copies {
  std::vector<std::size_t> from;
  std::vector<double> x, y, z, copy;
  StatedBonds bonds;
};

void add_bonds_of_copy(const RawSpheres& spheres, const std::vector<std::size_t>& members, Copies& copies) {
  if (spheres.attributes.bonds.empty()) return;
  constexpr std::int32_t kNone = -1;
  std::vector<std::int32_t> copy_of(spheres.size(), kNone);
  auto copy = static_cast<std::int32_t>(copies.from.size());
  for (const std::size_t i : members) copy_of[i] = copy++;
  for (const StatedBond& bond : spheres.attributes.bonds.list) {
    const std::int32_t one = copy_of[static_cast<std::size_t>(bond.one)];
    const std::int32_t other = copy_of[static_cast<std::size_t>(bond.other)];
    if (one != kNone && other != kNone) copies.bonds.add(one, other, bond.order);
  }
}

Status add_copy(const RawSpheres& spheres, const std::vector<std::size_t>& members, const Matrix& m, double number,
                Copies& copies) {
  add_bonds_of_copy(spheres, members, copies);
  for (const std::size_t i : members) {
    const double x = spheres.x[i], y = spheres.y[i], z = spheres.z[i];
    const std::array<double, 3> place{m[0] * x + m[1] * y + m[2] * z + m[3], m[4] * x + m[5] * y + m[6] * z + m[7],
                                      m[8] * x + m[9] * y + m[10] * z + m[11]};
    for (const double coordinate : place)
      if (const char* fault = coordinate_fault(coordinate))
        return Error{"a coordinate of this assembly " + std::string(fault), "", 0, 0, ""};
    copies.from.push_back(i);
    copies.x.push_back(place[0]);
    copies.y.push_back(place[1]);
    copies.z.push_back(place[2]);
    copies.copy.push_back(number);
  }
  return Done{};
}

// The spheres whose chain is one of these, in the file's order.
std::vector<std::size_t> members_of(const NamedTexts& column, const std::vector<std::string>& chains) {
  const std::unordered_set<std::string> wanted(chains.begin(), chains.end());
  std::vector<bool> is_wanted;
  for (const std::string& text : column.texts) is_wanted.push_back(wanted.count(text) > 0);
  std::vector<std::size_t> members;
  for (std::size_t i = 0; i < column.text_of_sphere.size(); ++i)
    if (is_wanted[static_cast<std::size_t>(column.text_of_sphere[i])]) members.push_back(i);
  return members;
}

Error no_such_assembly(const RawSpheres& spheres, const std::string& id, const std::string& file) {
  const std::vector<std::string> ids = spheres.assemblies.ids();
  if (ids.empty())
    return {"the file states no assemblies, so there is no " + quote(id), file, 0, 0,
            "leave " + setting_name("assembly") + " out"};
  std::string known;
  for (const std::string& one : ids) known += (known.empty() ? "there are " : ", ") + one;
  return {"there is no assembly " + quote(id), file, 0, 0, known};
}

}  // namespace

std::vector<std::string> Assemblies::ids() const {
  std::vector<std::string> ids;
  std::unordered_set<std::string> seen;
  for (const AssemblyPart& part : parts)
    if (seen.insert(part.assembly).second) ids.push_back(part.assembly);
  return ids;
}

Status expand_assembly(RawSpheres& spheres, const std::string& id, const std::string& file) {
  const OperatorExpression expressions(spheres.assemblies.operators, file);
  const NamedTexts* const column = chain_column(spheres.attributes);
  bool found = false;
  double number = 0;
  Copies copies;
  for (const AssemblyPart& part : spheres.assemblies.parts) {
    if (part.assembly != id || column == nullptr) continue;
    found = true;
    const Result<std::vector<Matrix>> matrices = expressions.matrices(part.operators);
    if (!matrices) return matrices.error();
    const std::vector<std::size_t> members = members_of(*column, part.chains);
    const double wanted = static_cast<double>(copies.from.size()) +
                          static_cast<double>(members.size()) * static_cast<double>(matrices->size());
    if (Status status = check_memory(wanted * kBytesPerCopiedSphere, "this assembly"); !status) return status.error();
    for (const Matrix& matrix : *matrices)
      if (Status status = add_copy(spheres, members, matrix, ++number, copies); !status) {
        Error error = status.error();
        error.file = file;
        return error;
      }
  }
  if (!found) return no_such_assembly(spheres, id, file);
  if (copies.from.empty()) return Error{"no atom is in the chains of assembly " + quote(id), file, 0, 0, ""};

  // Take the copies in place of the file's spheres.
  copy_attributes(spheres.attributes, copies.from);
  spheres.attributes.bonds.list = std::move(copies.bonds.list);
  spheres.attributes.bonds.put_in_order();
  copy_column(spheres.r, copies.from);
  spheres.x = std::move(copies.x);
  spheres.y = std::move(copies.y);
  spheres.z = std::move(copies.z);
  spheres.attributes.numbers.push_back({std::string(kAssemblyCopy), std::move(copies.copy)});
  spheres.rules.push_back("assembly " + id + ": " + std::to_string(static_cast<std::int64_t>(number)) +
                          (number == 1 ? " copy" : " copies") + " of chains, told apart by the column copy");
  return Done{};
}

}  // namespace bihive
