add_executable(monitor_node
  ${CMAKE_CURRENT_LIST_DIR}/changed_parameters.cpp
  ${CMAKE_CURRENT_LIST_DIR}/monitor_node.cpp
  ${CMAKE_CURRENT_LIST_DIR}/alarm_services.cpp
  ${CMAKE_CURRENT_LIST_DIR}/alarm_settings_service.cpp
  ${CMAKE_CURRENT_LIST_DIR}/alert_events.cpp
  ${CMAKE_CURRENT_LIST_DIR}/rival_report.cpp
  ${CMAKE_CURRENT_LIST_DIR}/run_node.cpp)
target_link_libraries(monitor_node PRIVATE whirl_twin_plugins whirl_twin_transport_ros
  whirl_twin_transport_lcm whirl_twin_core whirl_twin_ros whirl_twin_warnings)
set_target_properties(monitor_node PROPERTIES
  RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
