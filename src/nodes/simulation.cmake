add_executable(simulation_node
  ${CMAKE_CURRENT_LIST_DIR}/changed_parameters.cpp
  ${CMAKE_CURRENT_LIST_DIR}/checkpoint_saver.cpp
  ${CMAKE_CURRENT_LIST_DIR}/external_controllers.cpp
  ${CMAKE_CURRENT_LIST_DIR}/input_commands.cpp
  ${CMAKE_CURRENT_LIST_DIR}/lockstep_listeners.cpp
  ${CMAKE_CURRENT_LIST_DIR}/loop_report.cpp
  ${CMAKE_CURRENT_LIST_DIR}/record_publisher.cpp
  ${CMAKE_CURRENT_LIST_DIR}/rival_report.cpp
  ${CMAKE_CURRENT_LIST_DIR}/run_node.cpp
  ${CMAKE_CURRENT_LIST_DIR}/simulation_node.cpp
  ${CMAKE_CURRENT_LIST_DIR}/state_publisher.cpp
  ${CMAKE_CURRENT_LIST_DIR}/twin_services.cpp)
target_link_libraries(simulation_node PRIVATE whirl_twin_plugins whirl_twin_transport_ros
  whirl_twin_transport_lcm whirl_twin_core whirl_twin_ros whirl_twin_warnings)
set_target_properties(simulation_node PROPERTIES
  RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
