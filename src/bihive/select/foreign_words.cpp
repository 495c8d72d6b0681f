#include "bihive/select/foreign_words.h"

namespace bihive {
namespace {

struct ForeignWord {
  std::string_view word, advice;
};
constexpr std::string_view kNear = "write 'within 5 of resname LIG', and 'and not resname LIG' to leave it out";
constexpr std::string_view kBonded = "write 'bonded to resname LIG'";
constexpr std::string_view kNeighbour = "write 'bonded to resname LIG and not resname LIG'";
constexpr std::string_view kMolecule =
    "write 'same mol as', if there is a column mol, or 'within 1e9 bonds of' for what bonds join";
constexpr std::string_view kPlace = "compare coordinates: 'x^2 + y^2 < 25', 'z > 3'";
constexpr ForeignWord kForeignWords[] = {
    {"around", kNear},
    {"exwithin", kNear},
    {"pbwithin", kNear},
    {"near_to", kNear},
    {"beyond", "write 'not within 5 of resname LIG'"},
    {"expand", "write 'within 5 of resname LIG'"},
    {"gap", "write 'not within 5 of resname LIG'"},
    {"extend", "write 'within 2 bonds of resname LIG'"},
    {"bonded", kBonded},
    {"bound_to", kBonded},
    {"neighbor", kNeighbour},
    {"nbr", kNeighbour},
    {"bymolecule", kMolecule},
    {"bymol", kMolecule},
    {"bychain", "write 'same chain as'"},
    {"bysegi", "write 'same chain as'"},
    {"byobject", "there is one object; write 'all'"},
    {"group", "write the group's selection itself"},
    {"global", "leave it out"},
    {"prop", "compare the number: 'charge < 0'"},
    {"point", kPlace},
    {"sphlayer", kPlace},
    {"sphzone", kPlace},
    {"isolayer", kPlace},
    {"cylayer", kPlace},
    {"cyzone", kPlace},
    {"box", kPlace},
    {"fragment", kMolecule},
    {"pfrag", "write 'same chain as'"},
    {"polymer_type", "write protein or nucleic"},
    {"organic", "write ligand"},
    {"inorganic", "write ion"},
    {"metals", "write the elements: 'element Zn Fe Mg'"},
    {"noh", "write 'not hydrogen'"},
    {"nucleicbackbone", "write 'nucleic and backbone'"},
};

}  // namespace

std::string_view advice_on_foreign_word(std::string_view word) {
  for (const ForeignWord& one : kForeignWords)
    if (one.word == word) return one.advice;
  return {};
}

}  // namespace bihive
