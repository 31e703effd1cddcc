#include "scene_mutations.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <vector>

namespace whirl_twin {

namespace {

using Random = std::mt19937_64;

/// From 0 to count - 1. (Distributions of the standard library differ from one to the next.)
std::size_t below(Random& random, std::size_t count) {
  return count == 0 ? 0 : static_cast<std::size_t>(random() % count);
}

template <std::size_t n>
const char* oneOf(Random& random, const char* const (&choices)[n]) {
  return choices[below(random, n)];
}

/// Beginning and length of a piece of the text.
struct Piece {
  std::size_t begin, size;
};

std::vector<Piece> lines(const std::string& text) {
  std::vector<Piece> all;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
    all.push_back({begin, end - begin});
    begin = end;
  }
  return all;
}

/// All maximal runs of characters that satisfy `belongs`, with a first character that satisfies
/// `starts`.
template <class Starts, class Belongs>
std::vector<Piece> runs(const std::string& text, Starts starts, Belongs belongs) {
  std::vector<Piece> all;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::size_t begin = i;
    while (i < text.size() && belongs(static_cast<unsigned char>(text[i]))) {
      ++i;
    }
    if (i > begin && starts(static_cast<unsigned char>(text[begin]))) {
      all.push_back({begin, i - begin});
    }
  }
  return all;
}

std::vector<Piece> numbers(const std::string& text) {
  return runs(
      text, [](int c) { return std::isdigit(c) != 0; },
      [](int c) { return std::isalnum(c) || c == '.' || c == '-' || c == '+' || c == '_'; });
}

std::vector<Piece> words(const std::string& text) {
  return runs(
      text, [](int c) { return std::isalpha(c) != 0; },
      [](int c) { return std::isalnum(c) || c == '_'; });
}

void replaceOne(std::string& text, const std::vector<Piece>& pieces, const std::string& by,
                Random& random) {
  if (!pieces.empty()) {
    const Piece piece = pieces[below(random, pieces.size())];
    text.replace(piece.begin, piece.size, by);
  }
}

void flipBytes(std::string& text, Random& random) {
  for (std::size_t i = 1 + below(random, 4); i > 0 && !text.empty(); --i) {
    text[below(random, text.size())] ^= static_cast<char>(1u << below(random, 8));
  }
}

void deleteLine(std::string& text, Random& random) {
  replaceOne(text, lines(text), "", random);
}

void duplicateLine(std::string& text, Random& random) {
  const auto all = lines(text);
  if (!all.empty()) {
    const Piece line = all[below(random, all.size())];
    text.insert(all[below(random, all.size())].begin, text.substr(line.begin, line.size));
  }
}

void swapNumber(std::string& text, Random& random) {
  static constexpr const char* kNumbers[] = {
      "nan",     ".nan",
      "inf",     "-.inf",
      "-1",      "0",
      "-0.0",    "1e308",
      "1e-308",  "4e-324",
      "1e309",   "\"\"",
      "~",       "0x10",
      "1e",      "1,5",
      "--1",     "1e5000",
      "true",    "1.0.0",
      "[1, 2]",  "{}",
      "1000000", "0.3",
      "1e-9",    "9.999999999",
      "1e-10",   "123456789012345678901234567890123456789012345678901234567890"};
  replaceOne(text, numbers(text), oneOf(random, kNumbers), random);
}

void misspell(std::string& text, Random& random) {
  const auto all = words(text);
  if (all.empty()) {
    return;
  }
  const Piece word = all[below(random, all.size())];
  const std::size_t at = word.begin + below(random, word.size);
  switch (below(random, 4)) {
    case 0:
      text.erase(at, 1);
      break;
    case 1:
      text.insert(at, 1, static_cast<char>('a' + below(random, 26)));
      break;
    case 2:
      text[at] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[at])));
      break;
    default:
      text.insert(at, oneOf(random, {"\xc3\xa9", "\xe2\x80\xae", "\xf0\x9f\x8c\x80", "\xff", "-",
                                     " ", "/", "\x1b[31m", "\xef\xbb\xbf"}));
  }
}

void truncate(std::string& text, Random& random) {
  text.resize(below(random, text.size() + 1));
}

void nest(std::string& text, Random& random) {
  static constexpr const char* kOpenings[] = {"[", "{", "- ", "? ", "{a: ", "!!map "};
  const char* opening = oneOf(random, kOpenings);
  std::string deep;
  for (std::size_t i = below(random, 5000); i > 0; --i) {
    deep += opening;
  }
  replaceOne(text, numbers(text), deep, random);
}

void tabs(std::string& text, Random& random) {
  const std::size_t at = text.find("  ", below(random, text.size() + 1));
  if (at != std::string::npos) {
    text.replace(at, 2, "\t");
  }
}

void insertNull(std::string& text, Random& random) {
  text.insert(below(random, text.size() + 1), 1, '\0');
}

/// Anchors and aliases, some of them recursive.
void alias(std::string& text, Random& random) {
  static constexpr const char* kAnchors[] = {": &a",       ": *a", ": &a {a: *a}", ": &a [*a, *a]",
                                             ": !!binary", ": <<", ": |",          ": >-"};
  const char* anchor = oneOf(random, kAnchors);
  const auto colons = runs(
      text, [](int) { return true; }, [](int c) { return c == ':'; });
  replaceOne(text, colons, anchor, random);
  if (below(random, 2) == 0) {
    const auto all = lines(text);
    if (!all.empty()) {
      text.insert(all[below(random, all.size())].begin, "&a ");
    }
  }
}

void insertKey(std::string& text, Random& random) {
  static constexpr const char* kKeys[] = {"    substeps: 3\n",
                                          "    integrator: exponential\n",
                                          "    integrator: runge_kutta_4\n",
                                          "    tolerance: 0\n",
                                          "    horizon: -1\n",
                                          "time: 1e9\n",
                                          "time: 0.0000000001\n",
                                          "gravity: -1\n",
                                          "    drive: shaf\n",
                                          "systems: {}\n",
                                          "drives: []\n",
                                          "    model: double_pendulum\n",
                                          "  rotor: *\n",
                                          "%YAML 9.9\n",
                                          "---\n",
                                          "...\n",
                                          "? {a: b}: c\n",
                                          "    initial: {x: 1e308}\n",
                                          "    substeps: 1e99\n",
                                          "    parameters: 3\n",
                                          "name: [x]\n"};
  const auto all = lines(text);
  text.insert(all.empty() ? 0 : all[below(random, all.size())].begin, oneOf(random, kKeys));
}

}  // namespace

std::string mutated(std::string text, Random& random) {
  static constexpr void (*kMutations[])(std::string&, Random&) = {
      flipBytes, deleteLine, duplicateLine, swapNumber, swapNumber, misspell,
      truncate,  nest,       tabs,          insertNull, alias,      insertKey};
  for (std::size_t i = 1 + below(random, 4); i > 0; --i) {
    kMutations[below(random, std::size(kMutations))](text, random);
  }
  return text;
}

}  // namespace whirl_twin
