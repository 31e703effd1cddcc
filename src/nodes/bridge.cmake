add_executable(lcm_bridge_node
  ${CMAKE_CURRENT_LIST_DIR}/changed_parameters.cpp
  ${CMAKE_CURRENT_LIST_DIR}/lcm_bridge.cpp
  ${CMAKE_CURRENT_LIST_DIR}/lcm_bridge_node.cpp
  ${CMAKE_CURRENT_LIST_DIR}/newest_states.cpp
  ${CMAKE_CURRENT_LIST_DIR}/rival_report.cpp
  ${CMAKE_CURRENT_LIST_DIR}/run_node.cpp)
target_link_libraries(lcm_bridge_node PRIVATE whirl_twin_transport_ros whirl_twin_transport_lcm
  whirl_twin_core whirl_twin_ros whirl_twin_warnings)
set_target_properties(lcm_bridge_node PROPERTIES
  RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})

add_executable(command_bridge_node
  ${CMAKE_CURRENT_LIST_DIR}/changed_parameters.cpp
  ${CMAKE_CURRENT_LIST_DIR}/command_bridge_node.cpp
  ${CMAKE_CURRENT_LIST_DIR}/command_channels.cpp
  ${CMAKE_CURRENT_LIST_DIR}/command_lease.cpp
  ${CMAKE_CURRENT_LIST_DIR}/command_sender.cpp
  ${CMAKE_CURRENT_LIST_DIR}/command_taker.cpp
  ${CMAKE_CURRENT_LIST_DIR}/rival_report.cpp
  ${CMAKE_CURRENT_LIST_DIR}/run_node.cpp)
target_link_libraries(command_bridge_node PRIVATE whirl_twin_transport_ros whirl_twin_transport_lcm
  whirl_twin_core whirl_twin_ros whirl_twin_warnings)
set_target_properties(command_bridge_node PROPERTIES
  RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})

add_executable(lcm_recorder_node
  ${CMAKE_CURRENT_LIST_DIR}/lcm_recorder_node.cpp
  ${CMAKE_CURRENT_LIST_DIR}/run_node.cpp)
target_link_libraries(lcm_recorder_node PRIVATE whirl_twin_transport_ros whirl_twin_transport_lcm whirl_twin_core
  whirl_twin_ros whirl_twin_warnings)
set_target_properties(lcm_recorder_node PROPERTIES
  RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})

# `twin play` as a node, for playback.launch.
install(PROGRAMS ${PROJECT_SOURCE_DIR}/scripts/log_player
  DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
