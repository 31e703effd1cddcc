# How the modules of src/ are compiled.
#
# Reading headers is more than half of a compiler's time, so a module's sources go to it several at a time, in one
# translation unit ("unity build"): names in the unnamed namespaces of one module must differ. -DCMAKE_UNITY_BUILD=OFF
# compiles them one by one: for development (an edit recompiles one file), and to check that each file includes what it
# uses, which `scripts/test --long` does.
#
# What runs in a step is compiled with -O3, what computes beside it with -O2, the rest with -O1.
option(CMAKE_UNITY_BUILD "Compile several sources of a module in one translation unit" ON)

# Headers of others that most files include, read once for many targets. -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON builds
# without.
set(whirl_twin_common_headers
  <algorithm> <array> <cmath> <complex> <cstdint> <functional> <limits> <map> <memory> <optional> <string> <utility>
  <variant> <vector> <Eigen/Core> <fmt/format.h>)

# What every module is compiled against.
add_library(whirl_twin_libraries INTERFACE)
target_include_directories(whirl_twin_libraries INTERFACE ${PROJECT_SOURCE_DIR}/src)
target_link_libraries(whirl_twin_libraries INTERFACE
  Eigen3::Eigen fmt::fmt Boost::boost Threads::Threads yaml-cpp)

# whirl_twin_headers(NAME [OPTIONS OPTION...] [LIBRARIES LIB...] [HEADERS HEADER...]): headers that are precompiled, once
# for all targets of an optimization level that name them. g++ compiles whatever includes them with their options instead of
# those on its command line, and does not warn: both must be the same.
if(NOT EXISTS ${PROJECT_BINARY_DIR}/nothing.cpp)
  file(WRITE ${PROJECT_BINARY_DIR}/nothing.cpp "")
endif()
function(whirl_twin_headers name)
  cmake_parse_arguments(headers "" "" "OPTIONS;LIBRARIES;HEADERS" ${ARGN})
  foreach(key OPTIONS LIBRARIES HEADERS)
    set_property(GLOBAL PROPERTY ${name}_${key} "${headers_${key}}")
  endforeach()
endfunction()
whirl_twin_headers(whirl_twin_core_headers)
whirl_twin_headers(whirl_twin_step_headers OPTIONS ${whirl_twin_step_options})

# whirl_twin_compile(TARGET LEVEL BATCH [HEADERS]): its optimization in a release, how many of its sources are one unit,
# and which headers are precompiled for it, with the options that come with them.
function(whirl_twin_compile target level batch)
  set(options -fno-semantic-interposition $<$<CONFIG:Release>:${level}>)
  set_target_properties(${target} PROPERTIES UNITY_BUILD_BATCH_SIZE ${batch})
  if(ARGN)
    foreach(key OPTIONS LIBRARIES HEADERS)
      get_property(headers_${key} GLOBAL PROPERTY ${ARGN}_${key})
    endforeach()
    list(APPEND options ${headers_OPTIONS})
    set(precompiled ${ARGN}${level})
    if(NOT TARGET ${precompiled})
      add_library(${precompiled} OBJECT ${PROJECT_BINARY_DIR}/nothing.cpp)
      target_link_libraries(${precompiled} PRIVATE whirl_twin_libraries ${headers_LIBRARIES} whirl_twin_warnings)
      target_compile_options(${precompiled} PRIVATE ${options})
      target_precompile_headers(${precompiled} PRIVATE ${whirl_twin_common_headers} ${headers_HEADERS})
      set_target_properties(${precompiled} PROPERTIES UNITY_BUILD OFF)
    endif()
    target_precompile_headers(${target} REUSE_FROM ${precompiled})
  endif()
  target_link_libraries(${target} PRIVATE whirl_twin_warnings)
  target_compile_options(${target} PRIVATE ${options})
endfunction()

# whirl_twin_module(NAME [LIBRARY TARGET] OPTIMIZE LEVEL BATCH N [HEADERS NAME | NO_HEADERS] [OPTIONS OPTION...]
#   SOURCES SOURCE...):
# an object library whirl_twin_NAME_objects, a part of LIBRARY (whirl_twin_core). A module with further OPTIONS needs NO_HEADERS.
function(whirl_twin_module name)
  set(module_LIBRARY whirl_twin_core)
  set(module_HEADERS whirl_twin_core_headers)
  cmake_parse_arguments(given "NO_HEADERS" "LIBRARY;OPTIMIZE;BATCH;HEADERS" "OPTIONS;SOURCES" ${ARGN})
  foreach(key LIBRARY HEADERS)
    if(given_${key})
      set(module_${key} ${given_${key}})
    endif()
  endforeach()
  if(given_NO_HEADERS)
    set(module_HEADERS)
  endif()
  set(objects whirl_twin_${name}_objects)
  add_library(${objects} OBJECT ${given_SOURCES})
  target_link_libraries(${objects} PRIVATE whirl_twin_libraries)
  target_compile_options(${objects} PRIVATE ${given_OPTIONS})
  whirl_twin_compile(${objects} ${given_OPTIMIZE} ${given_BATCH} ${module_HEADERS})
  target_sources(${module_LIBRARY} PRIVATE $<TARGET_OBJECTS:${objects}>)
endfunction()
