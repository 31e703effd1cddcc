// Names that users give and read: which are legal, which was meant, and text made fit to be shown.
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

/// Bytes of the character that begins at `at`, in UTF-8; 0 where there is none (RFC 3629: no
/// overlong forms, no surrogates, nothing beyond U+10FFFF), or one that is not shown but obeyed:
/// control characters (C0, DEL, C1), breaks of lines, and marks that turn the direction of text.
std::size_t printableLength(std::string_view text, std::size_t at);

/// Bytes of a text from elsewhere that a message shows.
inline constexpr std::size_t kLongestShown = 60;

/// The first bytes of a text on one line, with \x1b for a byte that printableLength() refuses.
std::string printable(const std::string& text, std::size_t longest = kLongestShown);
/// The same in quotes.
std::string quoted(const std::string& text);

/// All of a text of several lines, likewise; line ends and tabs stay.
std::string printableLines(std::string_view text);

}  // namespace whirl_twin
