# LCM: the library, and the C++ types generated from msg/*.lcm. (LCM 1.3.1 ships no CMake config, and
# Debian's lcm.pc asks for GLib's development files, which nothing here needs.)
find_path(LCM_INCLUDE_DIR lcm/lcm-cpp.hpp)
find_library(LCM_LIBRARY lcm)
find_program(LCM_GEN lcm-gen)
if(NOT LCM_INCLUDE_DIR OR NOT LCM_LIBRARY OR NOT LCM_GEN)
  message(FATAL_ERROR "LCM was not found: install liblcm-dev and liblcm-bin, or configure with -DWHIRL_TWIN_LCM=OFF")
endif()

file(GLOB whirl_twin_lcm_types CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/msg/*.lcm)
set(whirl_twin_lcm_dir ${CMAKE_CURRENT_BINARY_DIR}/lcm_types)
set(whirl_twin_lcm_headers)
foreach(type ${whirl_twin_lcm_types})
  get_filename_component(name ${type} NAME_WE)
  set(header ${whirl_twin_lcm_dir}/whirl_twin/${name}.hpp)
  add_custom_command(OUTPUT ${header}
    COMMAND ${LCM_GEN} --cpp --cpp-std c++11 --cpp-hpath ${whirl_twin_lcm_dir} ${type}
    DEPENDS ${type} VERBATIM)
  list(APPEND whirl_twin_lcm_headers ${header})
endforeach()
add_custom_target(whirl_twin_lcm_types DEPENDS ${whirl_twin_lcm_headers})

add_library(whirl_twin_lcm INTERFACE)
target_include_directories(whirl_twin_lcm SYSTEM INTERFACE ${whirl_twin_lcm_dir} ${LCM_INCLUDE_DIR})
target_link_libraries(whirl_twin_lcm INTERFACE ${LCM_LIBRARY})
add_dependencies(whirl_twin_lcm whirl_twin_lcm_types)

# The same for Python, as the package whirl_twin_lcm.whirl_twin: `whirl_twin` is that of the ROS messages. lcm-gen adds
# to an __init__.py that is there.
if(WHIRL_TWIN_ROS)
  set(whirl_twin_lcm_python_dir ${CATKIN_DEVEL_PREFIX}/${CATKIN_GLOBAL_PYTHON_DESTINATION})
else()
  set(whirl_twin_lcm_python_dir ${CMAKE_CURRENT_BINARY_DIR}/python)
endif()
set(whirl_twin_lcm_python ${whirl_twin_lcm_python_dir}/whirl_twin_lcm)
add_custom_command(OUTPUT ${whirl_twin_lcm_python}/whirl_twin/__init__.py
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${whirl_twin_lcm_python}
  COMMAND ${LCM_GEN} --python --ppath ${whirl_twin_lcm_python_dir} --package-prefix whirl_twin_lcm
    ${whirl_twin_lcm_types}
  DEPENDS ${whirl_twin_lcm_types} VERBATIM)
add_custom_target(whirl_twin_lcm_python ALL DEPENDS ${whirl_twin_lcm_python}/whirl_twin/__init__.py)
