// A report as one HTML page with its pictures inside: it opens without a network, and prints.
#pragma once

#include <string>
#include <vector>

#include "plots/chart.h"

namespace whirl_twin {

class ReportPage {
 public:
  explicit ReportPage(const std::string& title);

  void section(const std::string& title);
  void part(const std::string& title);  ///< of a section
  void text(const std::string& words);
  void list(const std::vector<std::string>& lines);
  /// Cells that begin like numbers stand to the right.
  void table(const std::vector<std::string>& head,
             const std::vector<std::vector<std::string>>& rows);
  void picture(const Figure& figure);

  /// The whole file.
  std::string finish() const;

 private:
  std::string title_, body_;
  int pictures_ = 0;
};

/// Text between tags: their characters as entities, control characters as spaces.
std::string escapedForHtml(const std::string& text);

/// A picture for a page that has several: SVG whose names are its own, `number` among them. Cairo
/// calls the letters of each picture glyph-0-0, glyph-0-1 ..., and a page knows one of a name.
std::string inlinedPicture(const Figure& figure, int number);

}  // namespace whirl_twin
