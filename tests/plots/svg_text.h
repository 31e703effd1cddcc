// Checks of an SVG: well-formedness, and the number of elements of a kind.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace whirl_twin {

/// Every element that opens also closes, in order, and there is one root.
inline bool wellFormed(const std::string& xml) {
  std::vector<std::string> open;
  std::size_t roots = 0;
  for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at)) {
    const std::size_t end = xml.find('>', at);
    if (end == std::string::npos) {
      return false;
    }
    const std::string tag = xml.substr(at + 1, end - at - 1);
    at = end;
    if (tag.empty() || tag.find('<') != std::string::npos) {
      return false;
    }
    if (tag[0] == '?' || tag[0] == '!') {
      continue;
    }
    const std::string name =
        tag.substr(tag[0] == '/', tag.find_first_of(" \n/", 1) - (tag[0] == '/'));
    if (tag[0] == '/') {
      if (open.empty() || open.back() != name) {
        return false;
      }
      open.pop_back();
    } else {
      roots += open.empty();
      if (tag.back() != '/') {
        open.push_back(name);
      }
    }
  }
  return open.empty() && roots == 1;
}

inline std::size_t countOf(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

}  // namespace whirl_twin
