// Names in user input and output: validity, suggestions for misspelled names, and escaping of text
// for display.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace whirl_twin {

/// Longest name of a system, drive or coordinate [characters]: LCM allows a channel 63 of them, and
/// "TWIN_" + name + "_STABILITY" has to fit.
inline constexpr std::size_t kMaxNameLength = 48;

/// A letter, then letters, digits and underscores, at most kMaxNameLength: legal as a part of a ROS
/// name and of an LCM channel.
bool isLegalName(const std::string& name);

/// A letter, a digit or an underscore.
bool isNameCharacter(char c);

/// The candidate nearest in spelling, or "" if none is near.
std::string nearestName(const std::string& name, const std::vector<std::string>& candidates);

/// "; did you mean 'NEAREST'?", or, without a near one, "; there are: ALL".
std::string hint(const std::string& name, const std::vector<std::string>& candidates);

/// Length in bytes of the printable UTF-8 character at `at`; 0 where there is none (RFC 3629: no
/// overlong forms, no surrogates, nothing beyond U+10FFFF), or a control character (C0, DEL, C1), a
/// line break or a mark that changes the direction of text.
std::size_t printableLength(std::string_view text, std::size_t at);

/// Maximum number of bytes of external text in a message.
inline constexpr std::size_t kMaxShown = 60;

/// The first bytes of a text on one line, with \x1b for a byte that printableLength() rejects.
std::string printable(const std::string& text, std::size_t longest = kMaxShown);
/// The same in quotes.
std::string inQuotes(const std::string& text);

/// A whole text of several lines, likewise; line ends and tabs are kept.
std::string printableLines(std::string_view text);

}  // namespace whirl_twin
