# What `make install` copies. Message headers, message definitions and package.xml are catkin's own.
set(whirl_twin_node_names
  simulation_node follow_node monitor_node visualization_node lcm_bridge_node lcm_recorder_node command_bridge_node
  terminal_node)
set(whirl_twin_demo_nodes simulation_node monitor_node visualization_node terminal_node)

if(WHIRL_TWIN_ROS)
  set(whirl_twin_library_dir ${CATKIN_PACKAGE_LIB_DESTINATION})
  set(whirl_twin_share_dir ${CATKIN_PACKAGE_SHARE_DESTINATION})
  set(whirl_twin_node_dir ${CATKIN_PACKAGE_BIN_DESTINATION})
else()
  include(GNUInstallDirs)
  set(whirl_twin_library_dir ${CMAKE_INSTALL_LIBDIR})
endif()

# The programs, what rostopic needs to print their messages, and the types of LCM for Python: all that is installed. And
# the nodes that demo.launch starts, a third of it, for the first minutes.
add_custom_target(whirl_twin_programs)
add_custom_target(whirl_twin_demo)
if(TARGET whirl_twin_generate_messages_py)
  add_dependencies(whirl_twin_programs whirl_twin_generate_messages_py)
  add_dependencies(whirl_twin_demo whirl_twin_generate_messages_py)
endif()
if(TARGET whirl_twin_lcm_python)
  add_dependencies(whirl_twin_programs whirl_twin_lcm_python)
endif()

# A program finds the library beside it wherever the whole was installed, with no LD_LIBRARY_PATH.
foreach(node ${whirl_twin_node_names})
  if(TARGET ${node})
    add_dependencies(whirl_twin_programs ${node})
    if(${node} IN_LIST whirl_twin_demo_nodes)
      add_dependencies(whirl_twin_demo ${node})
    endif()
    file(RELATIVE_PATH to_library /${whirl_twin_node_dir} /${whirl_twin_library_dir})
    set_target_properties(${node} PROPERTIES INSTALL_RPATH "$ORIGIN/${to_library}")
    install(TARGETS ${node} RUNTIME DESTINATION ${whirl_twin_node_dir})
  endif()
endforeach()
if(TARGET twin)
  add_dependencies(whirl_twin_programs twin)
  set_target_properties(twin PROPERTIES INSTALL_RPATH "$ORIGIN/../${whirl_twin_library_dir}")
  install(TARGETS twin RUNTIME DESTINATION bin)
  install(FILES config/completion/50.whirl_twin.bash DESTINATION share/bash-completion/completions RENAME twin)
endif()

# Man pages of twin and of the nodes, from what they answer to --help; beside the bin of the devel space, where `man`
# looks for them.
find_program(whirl_twin_python NAMES python3)
if(TARGET twin AND whirl_twin_python AND NOT CMAKE_CROSSCOMPILING)
  set(whirl_twin_man_dir ${PROJECT_BINARY_DIR}/share/man/man1)
  if(WHIRL_TWIN_ROS)
    set(whirl_twin_man_dir ${CATKIN_DEVEL_PREFIX}/share/man/man1)
  endif()
  set(whirl_twin_explained twin)
  foreach(node ${whirl_twin_node_names})
    if(TARGET ${node})
      list(APPEND whirl_twin_explained ${node})
    endif()
  endforeach()
  set(whirl_twin_explained_files)
  foreach(program ${whirl_twin_explained})
    list(APPEND whirl_twin_explained_files $<TARGET_FILE:${program}>)
  endforeach()
  add_custom_command(OUTPUT ${whirl_twin_man_dir}/twin.1
    COMMAND ${whirl_twin_python} ${PROJECT_SOURCE_DIR}/cmake/man_pages ${whirl_twin_man_dir} ${whirl_twin_explained_files}
    DEPENDS ${whirl_twin_explained} ${PROJECT_SOURCE_DIR}/cmake/man_pages VERBATIM)
  add_custom_target(whirl_twin_man ALL DEPENDS ${whirl_twin_man_dir}/twin.1)
  install(DIRECTORY ${whirl_twin_man_dir}/ DESTINATION share/man/man1 OPTIONAL
    FILES_MATCHING PATTERN "twin*.1" PATTERN "whirl_twin-*.1")
endif()

install(TARGETS whirl_twin_core whirl_twin_studies
  ARCHIVE DESTINATION ${whirl_twin_library_dir}
  LIBRARY DESTINATION ${whirl_twin_library_dir})
foreach(module ${whirl_twin_library_modules})
  install(DIRECTORY src/${module} DESTINATION include/whirl_twin FILES_MATCHING PATTERN *.h)
endforeach()

# The site, where scripts/docs has built it.
install(DIRECTORY ${PROJECT_BINARY_DIR}/docs/html DESTINATION share/doc/whirl_twin COMPONENT documentation OPTIONAL)

if(NOT WHIRL_TWIN_ROS)
  install(DIRECTORY config/scenes config/studies DESTINATION share/whirl_twin/config)
  install(DIRECTORY web DESTINATION share/whirl_twin)
endif()
if(WHIRL_TWIN_ROS)
  install(DIRECTORY launch config web DESTINATION ${whirl_twin_share_dir})
  install(DIRECTORY msg DESTINATION ${whirl_twin_share_dir} FILES_MATCHING PATTERN *.lcm)
  install(DIRECTORY examples DESTINATION ${whirl_twin_share_dir} USE_SOURCE_PERMISSIONS
    FILES_MATCHING PATTERN *.py PATTERN *.cpp PATTERN *.yaml PATTERN __pycache__ EXCLUDE)
  if(WHIRL_TWIN_LCM)
    install(DIRECTORY ${whirl_twin_lcm_python} DESTINATION ${CATKIN_GLOBAL_PYTHON_DESTINATION}
      FILES_MATCHING PATTERN *.py)
  endif()
  # launch/follow.launch plays a record with it; in the devel space it is found where it lies.
  install(PROGRAMS examples/acquisition/csv_to_ros.py examples/external_controller/pd_by_ros.py
    DESTINATION ${whirl_twin_node_dir})
endif()
