// A page of text, tables and figures, which becomes one HTML file: it opens without a network, and
// prints (reports/drawings.h).
#pragma once

#include <string>
#include <vector>

#include "reports/figure.h"
#include "reports/output.h"

namespace whirl_twin {

class ReportPage {
 public:
  explicit ReportPage(const std::string& title);

  /// Below the title, in small print: scene file, date, version.
  void fact(const std::string& name, const std::string& value);
  /// A line of the box at the top.
  void summary(const std::string& line);
  void section(const std::string& title);
  void part(const std::string& title);  ///< of a section
  void text(const std::string& text);
  void list(const std::vector<std::string>& lines);
  /// A table. A cell is a string, or an object of `text` and `class`: danger, warning or info.
  /// Cells that begin like numbers are aligned to the right.
  void cells(const std::vector<std::string>& head, const std::vector<std::vector<Json>>& rows);
  void table(const std::vector<std::string>& head,
             const std::vector<std::vector<std::string>>& rows);
  void picture(const Figure& figure);

  const Json& json() const { return page_; }

 private:
  void add(const char* kind, Json content);

  Json page_;
};

}  // namespace whirl_twin
