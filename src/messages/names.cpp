#include "messages/names.h"

#include <fmt/format.h>

#include <algorithm>

namespace whirl_twin {

namespace {

constexpr std::size_t kLongestShown = 60;

bool isLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

std::size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) {
    row[j] = j;
  }
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

}  // namespace

bool isNameCharacter(char c) {
  return isLetter(c) || (c >= '0' && c <= '9') || c == '_';
}

bool isLegalName(const std::string& name) {
  return !name.empty() && name.size() <= kMaxNameLength && isLetter(name.front()) &&
         std::all_of(name.begin(), name.end(), isNameCharacter);
}

std::string nearestName(const std::string& name, const std::vector<std::string>& candidates) {
  std::string nearest;
  if (name.size() > kLongestShown) {
    return nearest;
  }
  std::size_t best = std::max<std::size_t>(2, name.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = editDistance(name, candidate);
    if (distance < best) {
      best = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string hint(const std::string& name, const std::vector<std::string>& candidates) {
  const std::string near = nearestName(name, candidates);
  return near.empty() ? fmt::format("; there are: {}", fmt::join(candidates, ", "))
                      : fmt::format("; did you mean '{}'?", near);
}

std::string printable(const std::string& text) {
  std::string clean;
  for (const char c : text.substr(0, kLongestShown)) {
    clean += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  }
  return text.size() > kLongestShown ? clean + "..." : clean;
}

std::string quoted(const std::string& text) {
  return "'" + printable(text) + "'";
}

}  // namespace whirl_twin
