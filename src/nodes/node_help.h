// `--help` of a node: answered before ROS is asked for, so that it needs no master.
#pragma once

#include <cstdio>
#include <cstring>

namespace whirl_twin {

/// True if the command line asks for help, which is then printed: what the node does, and its
/// private parameters (`_name:=value` on its command line, or <param> in a launch file).
inline bool toldHelp(int argc, char** argv, const char* help) {
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--help") == 0 || std::strcmp(argv[i], "-h") == 0) {
      std::fputs(help, stdout);
      return true;
    }
  }
  return false;
}

}  // namespace whirl_twin
