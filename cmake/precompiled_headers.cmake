# Headers of others that most files include, read once a target instead of once a file. Files include what they use all
# the same: -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON builds without. Sources with options of their own cannot use them.
set(whirl_twin_common_headers
  <algorithm> <array> <cmath> <complex> <cstdint> <functional> <limits> <map> <memory> <optional> <string> <utility>
  <variant> <vector> <Eigen/Core> <fmt/format.h>)

# whirl_twin_headers(NAME [OPTIONS OPTION...] LIBRARIES LIB... HEADERS HEADER...): a library of nothing but headers read
# once, for the targets of the same options that have them REUSE_FROM NAME.
if(NOT EXISTS ${PROJECT_BINARY_DIR}/nothing.cpp)
  file(WRITE ${PROJECT_BINARY_DIR}/nothing.cpp "")
endif()
function(whirl_twin_headers name)
  cmake_parse_arguments(headers "" "" "OPTIONS;LIBRARIES;HEADERS" ${ARGN})
  add_library(${name} OBJECT ${PROJECT_BINARY_DIR}/nothing.cpp)
  target_link_libraries(${name} PRIVATE ${headers_LIBRARIES} whirl_twin_warnings)
  target_compile_options(${name} PRIVATE ${headers_OPTIONS})
  target_precompile_headers(${name} PRIVATE ${whirl_twin_common_headers} ${headers_HEADERS})
endfunction()
