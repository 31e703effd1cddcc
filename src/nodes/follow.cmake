add_executable(follow_node
  ${CMAKE_CURRENT_LIST_DIR}/changed_parameters.cpp
  ${CMAKE_CURRENT_LIST_DIR}/follow_node.cpp
  ${CMAKE_CURRENT_LIST_DIR}/follow_publisher.cpp
  ${CMAKE_CURRENT_LIST_DIR}/machine_input.cpp
  ${CMAKE_CURRENT_LIST_DIR}/rival_report.cpp
  ${CMAKE_CURRENT_LIST_DIR}/run_node.cpp
  ${CMAKE_CURRENT_LIST_DIR}/state_publisher.cpp)
target_link_libraries(follow_node PRIVATE whirl_twin_plugins whirl_twin_transport_ros
  whirl_twin_transport_lcm whirl_twin_core whirl_twin_ros whirl_twin_warnings)
set_target_properties(follow_node PROPERTIES
  RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
