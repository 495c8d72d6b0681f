#include "bihive/io/formats/molecules/atom_columns.h"

#include <cmath>
#include <limits>
#include <utility>

#include "bihive/base/parse_number.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

double whole_number_from(std::string_view text) {
  const auto number = parse_int(text);
  return number ? static_cast<double>(*number) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

void AtomColumns::add(const AtomNames& names, double occupancy, double b_factor) {
  occupancy_.values.push_back(occupancy);
  b_factor_.values.push_back(b_factor);
  residue_number_.values.push_back(whole_number_from(names.residue_number));
  serial_.values.push_back(whole_number_from(names.serial));
  has_serials_ = has_serials_ || !std::isnan(serial_.values.back());
  record_.add(names.record);
  chain_.add(names.chain);
  residue_.add(names.residue);
  name_.add(names.name);
  insertion_.add(names.insertion);
  entity_.add(names.entity);
}

void AtomColumns::take(SphereAttributes& attributes) {
  for (NamedNumbers* numbers : {&occupancy_, &b_factor_, &residue_number_})
    attributes.numbers.push_back(std::move(*numbers));
  if (has_serials_) attributes.numbers.push_back(std::move(serial_));
  attributes.texts.push_back(printable_texts(record_.take("record")));
  attributes.texts.push_back(printable_texts(chain_.take("chain")));
  attributes.texts.push_back(printable_texts(residue_.take("resname")));
  attributes.texts.push_back(printable_texts(name_.take("name")));
  if (!insertion_.all_empty()) attributes.texts.push_back(printable_texts(insertion_.take("insertion")));
  if (!entity_.all_empty()) attributes.texts.push_back(printable_texts(entity_.take("entity")));
}

}  // namespace bihive
