// The only file that includes PEGTL for selections: the grammar, and the way from its parse tree to an Expression.
#include "bihive/select/parse_expression.h"

#include <algorithm>
#include <new>
#include <tao/pegtl.hpp>
#include <tao/pegtl/contrib/parse_tree.hpp>
#include <type_traits>
#include <utility>

#include "bihive/base/parse_number.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

// Rules have the names of the written grammar in docs/selections.md.
// NOLINTBEGIN(readability-identifier-naming)
namespace grammar {
using namespace tao::pegtl;  // NOLINT(google-build-using-namespace): the grammar reads as in docs/selections.md

// --- Characters ---
struct gap : star<space> {};
struct other_byte : not_range<'\0', '\x7f'> {};  // part of a character that is not ASCII
struct name_first : sor<alpha, one<'_'>, other_byte> {};
struct name_next : sor<alnum, one<'_', '[', ']'>, other_byte> {};
struct value_first : sor<alnum, one<'_', '*'>, other_byte> {};
struct value_next : sor<value_first, one<'\'', '+', '-', '.', '?', '[', ']', '/', '#', '@', '~'>> {};

// --- Words that the language keeps for itself ---
template <class Word>
struct keyword : seq<Word, not_at<name_next>, gap> {};
struct word_and : istring<'a', 'n', 'd'> {};
struct word_or : istring<'o', 'r'> {};
struct word_not : istring<'n', 'o', 't'> {};
struct word_of : istring<'o', 'f'> {};
struct word_within : istring<'w', 'i', 't', 'h', 'i', 'n'> {};
struct word_bonds : seq<istring<'b', 'o', 'n', 'd'>, opt<istring<'s'>>> {};
struct word_bonded : istring<'b', 'o', 'n', 'd', 'e', 'd'> {};
struct word_to : istring<'t', 'o'> {};
struct word_same : istring<'s', 'a', 'm', 'e'> {};
struct word_as : istring<'a', 's'> {};
struct word_byres : istring<'b', 'y', 'r', 'e', 's'> {};
struct reserved : seq<sor<word_and, word_or, word_not, word_of, word_within>, not_at<value_next>> {};

struct and_sign : seq<sor<keyword<word_and>, seq<one<'&'>, opt<one<'&'>>, gap>>> {};
struct or_sign : seq<sor<keyword<word_or>, seq<one<'|'>, opt<one<'|'>>, gap>>> {};
struct not_sign : sor<keyword<word_not>, seq<one<'!'>, not_at<one<'='>>, gap>> {};
struct within_word : keyword<word_within> {};
struct of_word : keyword<word_of> {};
struct open : seq<one<'('>, gap> {};
struct close : seq<one<')'>, gap> {};

// --- Numbers, names, quotes ---
struct fraction : seq<one<'.'>, not_at<one<'.'>>, star<digit>> {};
struct exponent : seq<one<'e', 'E'>, opt<one<'+', '-'>>, plus<digit>> {};
struct digits : seq<sor<seq<plus<digit>, opt<fraction>>, seq<one<'.'>, plus<digit>>>, opt<exponent>> {};
struct signed_digits : seq<opt<one<'+', '-'>>, digits> {};
struct double_quoted : seq<one<'"'>, star<sor<two<'"'>, not_one<'"'>>>, one<'"'>> {};
struct single_quoted : seq<one<'\''>, star<sor<two<'\''>, not_one<'\''>>>, one<'\''>> {};
struct quoted : sor<double_quoted, single_quoted> {};
struct plain_name : seq<not_at<reserved>, name_first, star<name_next>> {};
struct name : seq<sor<quoted, plain_name>, gap> {};

// --- Arithmetic and comparisons ---
struct sum;
struct number : seq<digits> {};
struct number_token : seq<number, not_at<name_next>, gap> {};
struct minus_sign : one<'-'> {};
struct minus_token : seq<minus_sign, gap> {};
struct times_sign : one<'*', '/'> {};
struct times_token : seq<times_sign, gap> {};
struct plus_sign : one<'+', '-'> {};
struct plus_token : seq<plus_sign, gap> {};
struct function_name : sor<istring<'s', 'q', 'r', 't'>, istring<'a', 'b', 's'>> {};
struct function : seq<function_name, gap, open, sum, close> {};
struct primary : sor<function, number_token, name, seq<open, sum, close>> {};
struct power_token : seq<one<'^'>, gap> {};
struct exponent_factor : seq<star<minus_token>, primary> {};
struct power : seq<primary, opt<power_token, exponent_factor>> {};
struct factor : seq<star<minus_token>, power> {};
struct product : seq<factor, star<times_token, factor>> {};
struct sum : seq<product, star<plus_token, product>> {};
struct comparison_sign
    : sor<string<'<', '='>, string<'>', '='>, string<'=', '='>, string<'!', '='>, one<'<', '>', '='>> {};
struct comparison_token : seq<comparison_sign, gap> {};
struct comparison : seq<sum, plus<comparison_token, sum>> {};

// --- Names with values ---
// A minus with a blank before it alone is the sign of another value: 5 -3.
struct range_minus : sor<seq<one<'-'>, gap>, seq<plus<space>, one<'-'>, sor<plus<space>, at<one<'-'>>>>> {};
struct range_sign
    : sor<seq<gap, sor<two<'.'>, one<':'>>, gap>, seq<plus<space>, istring<'t', 'o'>, plus<space>>, range_minus> {};
struct range_value : seq<signed_digits, range_sign, signed_digits, not_at<value_next>> {};
struct number_value : seq<signed_digits, not_at<value_next>> {};
struct plain_value : seq<not_at<reserved>, value_first, star<value_next>> {};
struct value : seq<sor<range_value, number_value, quoted, plain_value>, gap> {};
struct comma : seq<one<','>, gap> {};
struct test : seq<name, star<opt<comma>, value>> {};

// --- Selections ---
struct disjunction;
struct distance : seq<signed_digits> {};
struct distance_token : seq<distance, not_at<name_next>, gap> {};
struct within_prefix : seq<within_word, distance_token, of_word> {};
struct bonds_prefix : seq<within_word, distance_token, keyword<word_bonds>, of_word> {};
struct bonded_prefix : seq<keyword<word_bonded>, keyword<word_to>> {};
struct byres_prefix : seq<keyword<word_byres>> {};
struct same_prefix : seq<keyword<word_same>, name, keyword<word_as>> {};
struct inner : seq<open, disjunction, close> {};
struct prefix : sor<not_sign, bonds_prefix, within_prefix, bonded_prefix, same_prefix, byres_prefix> {};
struct operand : seq<star<prefix>, sor<comparison, inner, test>> {};
struct conjunction : seq<operand, star<and_sign, operand>> {};
struct disjunction : seq<conjunction, star<or_sign, conjunction>> {};
struct end_of_text : eof {};
struct whole : seq<gap, disjunction, end_of_text> {};
struct whole_sum : seq<gap, sum, end_of_text> {};

template <class Rule>
using selector = parse_tree::selector<
    Rule, parse_tree::store_content::on<not_sign, bonds_prefix, within_prefix, bonded_prefix, same_prefix, byres_prefix,
                                        distance, function_name, function, exponent_factor, power, quoted, plain_name,
                                        number, minus_sign, times_sign, plus_sign, factor, product, sum,
                                        comparison_sign, comparison, range_value, number_value, signed_digits,
                                        plain_value, test, operand, conjunction, disjunction>>;
}  // namespace grammar
// NOLINTEND(readability-identifier-naming)

// --- What was expected where the text does not fit ---------------------------------------------------------------

enum Expected : unsigned {
  kNothingSpecial = 0,
  kPrefix = 1,  // a selection may begin here
  kTermName = 2,
  kValue = 4,
  kComparison = 8,
  kDistance = 16,
  kOf = 32,
  kConnective = 64,
  kClose = 128,
  kEnd = 256
};

// Rules that are leaves or become nodes: PEGTL's parse tree tells of no others.
template <class Rule>
constexpr unsigned kExpectedBy = kNothingSpecial;
template <>
constexpr unsigned kExpectedBy<grammar::not_sign> = kPrefix;
template <>
constexpr unsigned kExpectedBy<grammar::plain_name> = kTermName;
template <>
constexpr unsigned kExpectedBy<grammar::plain_value> = kValue;
template <>
constexpr unsigned kExpectedBy<grammar::comparison_sign> = kComparison;
template <>
constexpr unsigned kExpectedBy<grammar::distance> = kDistance;
template <>
constexpr unsigned kExpectedBy<grammar::of_word> = kOf;
template <>
constexpr unsigned kExpectedBy<grammar::and_sign> = kConnective;
template <>
constexpr unsigned kExpectedBy<grammar::close> = kClose;
template <>
constexpr unsigned kExpectedBy<grammar::end_of_text> = kEnd;

// The grammar's recursion went too far; `place`: behind the parenthesis that opens one level too many.
struct TooDeep {
  TextPlace place;
};

// How deep the grammar is in parentheses: every one leads to another disjunction, or to another sum of a comparison.
// Counted while it reads, because only the grammar knows which parentheses stand in quotes.
struct Nesting {
  int disjunctions = 0, sums = 0;

  void enter(int& rules, TextPlace place) {
    ++rules;
    if (disjunctions + sums - (sums > 0 ? 2 : 1) > kDeepestSelection) throw TooDeep{place};
  }
};

// The farthest place that any rule reached and could not pass, and what these rules wanted there.
struct FarthestFailure {
  TextPlace place = 0;
  unsigned expected = kNothingSpecial;
  std::vector<TextPlace> begun;  // of the kWatched rules that are being tried
  Nesting nesting;

  void begin(TextPlace at) { begun.push_back(at); }
  void succeed() { begun.pop_back(); }
  void fail(unsigned what) {
    const TextPlace at = begun.back();
    begun.pop_back();
    if (at > place) expected = kNothingSpecial;
    if (at < place) return;
    place = at;
    expected |= what;
  }
};

template <class Rule>
struct Watch : tao::pegtl::normal<Rule> {
  static constexpr bool kWatched = kExpectedBy<Rule> != kNothingSpecial;
  static constexpr bool kDisjunction = std::is_same_v<Rule, grammar::disjunction>;
  static constexpr bool kSum = std::is_same_v<Rule, grammar::sum>;

  template <class Input>
  static void start(const Input& in, FarthestFailure& farthest) {
    if constexpr (kWatched) farthest.begin(in.position().byte);
    if constexpr (kDisjunction) farthest.nesting.enter(farthest.nesting.disjunctions, in.position().byte);
    if constexpr (kSum) farthest.nesting.enter(farthest.nesting.sums, in.position().byte);
  }
  template <class Input>
  static void success(const Input&, FarthestFailure& farthest) {
    if constexpr (kWatched) farthest.succeed();
    leave(farthest);
  }
  template <class Input>
  static void failure(const Input&, FarthestFailure& farthest) {
    if constexpr (kWatched) farthest.fail(kExpectedBy<Rule>);
    leave(farthest);
  }

 private:
  static void leave(FarthestFailure& farthest) {
    if constexpr (kDisjunction) --farthest.nesting.disjunctions;
    if constexpr (kSum) --farthest.nesting.sums;
  }
};

std::string expectation(unsigned expected) {
  if ((expected & kPrefix) != 0) return "a selection such as 'chain A', 'x > 3' or 'all'";
  if ((expected & kTermName) != 0) return "a number or the name of a number";
  if ((expected & kDistance) != 0) return "a distance, as in 'within 5 of ...'";
  if ((expected & kOf) != 0) return "'of', as in 'within 5 of ...'";
  std::string list;
  const std::pair<unsigned, const char*> names[] = {{kValue, "a value"},
                                                    {kComparison, "a comparison"},
                                                    {kConnective, "'and', 'or'"},
                                                    {kClose, "')'"},
                                                    {kEnd, "the end"}};
  for (const auto& [bit, name] : names)
    if ((expected & bit) != 0) list += (list.empty() ? "" : ", ") + std::string(name);
  return list.empty() ? "something else" : list;
}

std::string found_at(std::string_view text, TextPlace place) {
  if (place >= text.size()) return "the end";
  std::string_view rest = text.substr(place);
  if (rest.front() == '"' || rest.front() == '\'') return "a quote that does not close, or a text at a wrong place";
  const std::size_t length = rest.find_first_of(" \t\r\n()");
  rest = rest.substr(0, std::max<std::size_t>(length, 1));
  return quote(rest);
}

// --- From the parse tree to the expression ------------------------------------------------------------------------

using ParseNode = tao::pegtl::parse_tree::node;

TextPlace place_of(const ParseNode& node) {
  return node.begin().byte;
}

bool is_quoted(const ParseNode& node) {
  return node.is_type<grammar::quoted>();
}

// A name or value without its quotes; a doubled quote inside stands for one.
std::string text_of(const ParseNode& node) {
  const std::string written = node.string();
  if (!is_quoted(node)) return written;
  std::string text;
  for (std::size_t i = 1; i + 1 < written.size(); ++i) {
    text += written[i];
    if (written[i] == written.front()) ++i;
  }
  return text;
}

double number_of(const ParseNode& node) {
  return parse_double(node.string_view()).value_or(0);
}

NumberTerm term_of(const ParseNode& node);

// Operands with signs between them, from left to right.
NumberTerm chain_of(const ParseNode& node) {
  if (node.children.size() == 1) return term_of(*node.children.front());
  NumberTerm chain;
  chain.kind = NumberTerm::Kind::chain;
  chain.place = place_of(node);
  for (std::size_t i = 0; i < node.children.size(); i += 2) {
    if (i > 0) chain.signs += node.children[i - 1]->string_view().front();
    chain.operands.push_back(term_of(*node.children[i]));
  }
  return chain;
}

// Two minus signs are none.
NumberTerm factor_of(const ParseNode& node) {
  NumberTerm term = term_of(*node.children.back());
  if (node.children.size() % 2 == 1) return term;
  NumberTerm negative;
  negative.kind = NumberTerm::Kind::negative;
  negative.place = place_of(node);
  negative.operands.push_back(std::move(term));
  return negative;
}

// A function of one operand, or a base and its exponent.
NumberTerm function_of(const ParseNode& node, NumberTerm::Kind kind) {
  NumberTerm term;
  term.kind = kind;
  term.place = place_of(node);
  for (const auto& child : node.children)
    if (!child->is_type<grammar::function_name>()) term.operands.push_back(term_of(*child));
  return term;
}

NumberTerm::Kind kind_of_function(const ParseNode& node) {
  const char first = node.children.front()->string_view().front();
  return first == 's' || first == 'S' ? NumberTerm::Kind::square_root : NumberTerm::Kind::absolute;
}

NumberTerm term_of(const ParseNode& node) {
  if (node.is_type<grammar::factor>() || node.is_type<grammar::exponent_factor>()) return factor_of(node);
  if (node.is_type<grammar::function>()) return function_of(node, kind_of_function(node));
  if (node.is_type<grammar::power>())
    return node.children.size() == 1 ? term_of(*node.children.front()) : function_of(node, NumberTerm::Kind::power);
  if (node.is_type<grammar::sum>() || node.is_type<grammar::product>()) return chain_of(node);
  NumberTerm term;
  term.place = place_of(node);
  term.text = text_of(node);
  if (node.is_type<grammar::number>())
    term.number = number_of(node);
  else
    term.kind = NumberTerm::Kind::name;
  return term;
}

SelectionValue value_of_node(const ParseNode& node) {
  SelectionValue value;
  value.place = place_of(node);
  value.text = text_of(node);
  value.quoted = is_quoted(node);
  if (node.is_type<grammar::range_value>()) {
    value.kind = SelectionValue::Kind::range;
    value.first = number_of(*node.children.front());
    value.last = number_of(*node.children.back());
  } else if (node.is_type<grammar::number_value>()) {
    value.kind = SelectionValue::Kind::number;
    value.first = value.last = number_of(*node.children.front());
  }
  return value;
}

ComparisonSign sign_of(std::string_view text) {
  if (text == "<") return ComparisonSign::less;
  if (text == "<=") return ComparisonSign::at_most;
  if (text == ">") return ComparisonSign::more;
  if (text == ">=") return ComparisonSign::at_least;
  return text == "!=" ? ComparisonSign::unequal : ComparisonSign::equal;
}

Expression expression_of(const ParseNode& node);

Expression test_of(const ParseNode& node) {
  Expression made;
  made.place = place_of(node);
  made.name = text_of(*node.children.front());
  made.kind = node.children.size() > 1 ? Expression::Kind::values : Expression::Kind::word;
  for (std::size_t i = 1; i < node.children.size(); ++i) made.values.push_back(value_of_node(*node.children[i]));
  return made;
}

Expression comparison_of(const ParseNode& node) {
  Expression made;
  made.kind = Expression::Kind::comparison;
  made.place = place_of(node);
  for (const auto& child : node.children) {
    if (child->is_type<grammar::comparison_sign>())
      made.signs.push_back(sign_of(child->string_view()));
    else
      made.terms.push_back(term_of(*child));
  }
  return made;
}

// Prefixes stand before their operand; the last one belongs closest to it. Two 'not' are none, so that they do not
// nest.
Expression operand_of(const ParseNode& node) {
  Expression made = expression_of(*node.children.back());
  const auto is_not = [&node](std::size_t i) { return node.children[i]->is_type<grammar::not_sign>(); };
  for (std::size_t i = node.children.size() - 1; i-- > 0;) {
    if (is_not(i) && i > 0 && is_not(i - 1)) {
      --i;
      continue;
    }
    const ParseNode& prefix = *node.children[i];
    Expression outer;
    outer.place = place_of(prefix);
    outer.kind = Expression::Kind::negation;
    if (prefix.is_type<grammar::within_prefix>() || prefix.is_type<grammar::bonds_prefix>()) {
      outer.kind = prefix.is_type<grammar::within_prefix>() ? Expression::Kind::within : Expression::Kind::within_bonds;
      outer.distance = number_of(*prefix.children.front());
    } else if (prefix.is_type<grammar::bonded_prefix>()) {
      outer.kind = Expression::Kind::bonded;
    } else if (!is_not(i)) {
      outer.kind = Expression::Kind::same;
      outer.name = prefix.is_type<grammar::same_prefix>() ? text_of(*prefix.children.front()) : "residue";
    }
    outer.operands.push_back(std::move(made));
    made = std::move(outer);
  }
  return made;
}

Expression expression_of(const ParseNode& node) {
  if (node.is_type<grammar::test>()) return test_of(node);
  if (node.is_type<grammar::comparison>()) return comparison_of(node);
  if (node.is_type<grammar::operand>()) return operand_of(node);
  if (node.children.size() == 1) return expression_of(*node.children.front());
  Expression made;
  made.kind = node.is_type<grammar::conjunction>() ? Expression::Kind::conjunction : Expression::Kind::disjunction;
  made.place = place_of(node);
  for (const auto& child : node.children) made.operands.push_back(expression_of(*child));
  return made;
}

// The place of the 'within', 'bonded', 'same' or 'byres' beyond the most that a selection may have; text.size() if
// there is none.
TextPlace too_many_prefixes(const ParseNode& node, int& left, std::size_t none) {
  const bool counts = node.is_type<grammar::within_prefix>() || node.is_type<grammar::bonds_prefix>() ||
                      node.is_type<grammar::bonded_prefix>() || node.is_type<grammar::same_prefix>() ||
                      node.is_type<grammar::byres_prefix>();
  if (counts && --left < 0) return place_of(node);
  for (const auto& child : node.children)
    if (const TextPlace place = too_many_prefixes(*child, left, none); place != none) return place;
  return none;
}

}  // namespace

Error selection_error(std::string_view text, TextPlace place, const std::string& message, const std::string& hint) {
  const std::string_view before = text.substr(0, std::min(place, text.size()));
  const std::size_t line_end = before.rfind('\n');
  const std::string_view line = line_end == std::string_view::npos ? before : before.substr(line_end + 1);
  // Count characters: bytes that continue one do not count.
  const auto characters =
      std::count_if(line.begin(), line.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; });
  Error error{message, "", 0, 0, hint};
  error.line = 1 + static_cast<std::int64_t>(std::count(before.begin(), before.end(), '\n'));
  error.column = 1 + static_cast<std::int64_t>(characters);
  return error;
}

namespace {

// The first node that Rule makes of the text.
template <class Rule, class Use>
auto parse_text(std::string_view text, const Use& use) -> decltype(use(std::declval<const ParseNode&>())) {
  if (text.size() > kLongestSelection)
    return selection_error(text, 0, "a selection has at most " + std::to_string(kLongestSelection) + " bytes");
  try {
    tao::pegtl::memory_input<> input(text.data(), text.size(), "");
    FarthestFailure farthest;
    const auto root =
        tao::pegtl::parse_tree::parse<Rule, ParseNode, grammar::selector, tao::pegtl::nothing, Watch>(input, farthest);
    if (!root)
      return selection_error(
          text, farthest.place,
          "expected " + expectation(farthest.expected) + ", found " + found_at(text, farthest.place));
    return use(*root->children.front());
  } catch (const TooDeep& deep) {
    return selection_error(text, text.rfind('(', deep.place - 1),
                           "parentheses lie at most " + std::to_string(kDeepestSelection) + " deep in each other");
  } catch (const std::bad_alloc&) {
    throw;  // nothing is wrong with the expression
  } catch (const std::exception& e) {
    return Error{"reading the selection failed: " + std::string(e.what()), "", 0, 0, ""};
  }
}

}  // namespace

Result<NumberTerm> parse_number_term(std::string_view text) {
  return parse_text<grammar::whole_sum>(text, [](const ParseNode& sum) -> Result<NumberTerm> { return term_of(sum); });
}

Result<Expression> parse_expression(std::string_view text) {
  return parse_text<grammar::whole>(text, [text](const ParseNode& whole) -> Result<Expression> {
    int prefixes_left = kDeepestSelection;
    if (const TextPlace place = too_many_prefixes(whole, prefixes_left, text.size()); place != text.size())
      return selection_error(text, place,
                             "a selection has at most " + std::to_string(kDeepestSelection) +
                                 " times 'within', 'bonded', 'same' or 'byres'");
    return expression_of(whole);
  });
}

}  // namespace bihive
