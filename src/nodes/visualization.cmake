foreach(node visualization_node terminal_node)
  add_executable(${node} ${CMAKE_CURRENT_LIST_DIR}/${node}.cpp)
  target_link_libraries(${node} PRIVATE whirl_twin_display whirl_twin_core whirl_twin_ros
    whirl_twin_warnings)
  set_target_properties(${node} PROPERTIES
    RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
endforeach()
target_link_libraries(visualization_node PRIVATE whirl_twin_plugins)
