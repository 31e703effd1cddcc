// Names that users give and read: which are legal, which was meant, and text made fit to be shown.
#pragma once

#include <cstddef>
#include <string>
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

/// The beginning of a text in quotes, without what a terminal might obey.
std::string quoted(const std::string& text);
/// The same without quotes.
std::string printable(const std::string& text);

}  // namespace whirl_twin
