// Files of figures and pages that a command writes. Python draws them; without it everything else
// of the command line works.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "reports/figure.h"
#include "reports/output.h"

namespace whirl_twin {

/// Of files that appear together: all, or none.
class Drawings {
 public:
  /// The name ends in .svg, .png or .pdf; or in .json, of a file with the figure's data, for which
  /// no Python is needed. Throws RunFailure if there is no such folder.
  void add(const std::string& path, const Json& figure);
  /// The curves of several figures over each other, each under its name; not as .json.
  void addOverlaid(const std::string& path, const Json& figures_by_name);
  /// HTML, of a ReportPage.
  void addPage(const std::string& path, const Json& page);

  /// Draws, and gives the files their names. Throws RunFailure.
  /// @return their paths
  std::vector<std::string> write();

 private:
  void await(const std::string& path, const std::string& format, const char* key, const Json& data);

  struct File {
    std::string path;
    std::unique_ptr<PendingFile> pending;
  };
  std::vector<File> files_;
  Json request_ = Json::array();  // of Python
};

/// "svg" of FILE.svg; "" of a name that is none of a figure.
std::string figureFormat(const std::string& path);

}  // namespace whirl_twin
