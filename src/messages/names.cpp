#include "messages/names.h"

#include <fmt/format.h>

#include <algorithm>

namespace whirl_twin {

namespace {

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

/// A character with an effect on the terminal or text direction instead of a glyph.
bool isObeyed(unsigned code) {
  const auto within = [code](unsigned first, unsigned last) {
    return code >= first && code <= last;
  };
  return code < 0x20 || within(0x7f, 0x9f) || code == 0x61c || within(0x200e, 0x200f) ||
         within(0x2028, 0x202e) || within(0x2066, 0x2069);
}

void takeCharacter(std::string_view text, std::size_t& at, std::size_t length, std::string& clean) {
  if (length > 0) {
    clean += text.substr(at, length);
  } else {
    clean += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[at]));
  }
  at += std::max<std::size_t>(length, 1);
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
  if (name.size() > kMaxShown) {
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

std::size_t printableLength(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
  };
  const unsigned lead = byte(at);
  const std::size_t length = lead < 0x80   ? 1
                             : lead < 0xc2 ? 0
                             : lead < 0xe0 ? 2
                             : lead < 0xf0 ? 3
                             : lead < 0xf5 ? 4
                                           : 0;
  unsigned code = length < 2 ? lead : lead & (0x7fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(at + i) & 0xc0u) != 0x80u) {
      return 0;
    }
    code = code << 6u | (byte(at + i) & 0x3fu);
  }
  const bool impossible = (length == 3 && code < 0x800) || (code >= 0xd800 && code < 0xe000) ||
                          (length == 4 && (code < 0x10000 || code > 0x10ffff));
  return impossible || isObeyed(code) ? 0 : length;
}

std::string printable(const std::string& text, std::size_t longest) {
  std::string clean;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t length = printableLength(text, at);
    if (at + std::max<std::size_t>(length, 1) > longest) {
      return clean + "...";
    }
    takeCharacter(text, at, length, clean);
  }
  return clean;
}

std::string printableLines(std::string_view text) {
  std::string clean;
  clean.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const bool layout = text[at] == '\n' || text[at] == '\t';
    takeCharacter(text, at, layout ? 1 : printableLength(text, at), clean);
  }
  return clean;
}

std::string inQuotes(const std::string& text) {
  return "'" + printable(text) + "'";
}

}  // namespace whirl_twin
