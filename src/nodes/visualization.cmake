# The displays, apart from their mains so that tests can link them.
add_library(whirl_twin_display STATIC
  ${CMAKE_CURRENT_LIST_DIR}/coordinate_bars.cpp
  ${CMAKE_CURRENT_LIST_DIR}/marker_canvas.cpp
  ${CMAKE_CURRENT_LIST_DIR}/orbit_trail.cpp
  ${CMAKE_CURRENT_LIST_DIR}/mechanism_display.cpp
  ${CMAKE_CURRENT_LIST_DIR}/rotor_display.cpp
  ${CMAKE_CURRENT_LIST_DIR}/scene_dynamics.cpp
  ${CMAKE_CURRENT_LIST_DIR}/scene_parameters.cpp
  ${CMAKE_CURRENT_LIST_DIR}/sketch_drawing.cpp
  ${CMAKE_CURRENT_LIST_DIR}/status_text.cpp
  ${CMAKE_CURRENT_LIST_DIR}/system_display.cpp
  ${CMAKE_CURRENT_LIST_DIR}/terminal_text.cpp
  ${CMAKE_CURRENT_LIST_DIR}/twin_listener.cpp
  ${CMAKE_CURRENT_LIST_DIR}/whirl_scale.cpp)
target_link_libraries(whirl_twin_display PUBLIC whirl_twin_core whirl_twin_ros
  PRIVATE whirl_twin_warnings)

foreach(node visualization_node terminal_node)
  add_executable(${node} ${CMAKE_CURRENT_LIST_DIR}/${node}.cpp)
  target_link_libraries(${node} PRIVATE whirl_twin_display whirl_twin_core whirl_twin_ros
    whirl_twin_warnings)
  set_target_properties(${node} PROPERTIES
    RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
endforeach()
target_link_libraries(visualization_node PRIVATE whirl_twin_plugins)
