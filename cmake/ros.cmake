# ROS 1: the messages of msg/, the services of srv/, and catkin's idea of this package.
if(NOT PYTHON_EXECUTABLE)
  # Debian's ROS modules belong to Debian's Python, which need not be the first on PATH.
  set(PYTHON_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "The Python that has the ROS modules")
endif()

set(whirl_twin_ros_packages
  roscpp std_msgs std_srvs sensor_msgs geometry_msgs visualization_msgs diagnostic_msgs
  diagnostic_updater rosgraph_msgs tf2 tf2_ros)
find_package(catkin REQUIRED COMPONENTS ${whirl_twin_ros_packages} message_generation)

file(GLOB whirl_twin_messages CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}/msg
  ${CMAKE_CURRENT_SOURCE_DIR}/msg/*.msg)
file(GLOB whirl_twin_services CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}/srv
  ${CMAKE_CURRENT_SOURCE_DIR}/srv/*.srv)
add_message_files(DIRECTORY msg FILES ${whirl_twin_messages})
add_service_files(DIRECTORY srv FILES ${whirl_twin_services})
generate_messages(DEPENDENCIES std_msgs)

# A plugin is compiled for the processor the library is for, so that both align matrices alike.
string(REPLACE ";" " " whirl_twin_step_flags "${whirl_twin_step_options}")
set(whirl_twin_native_option)
if(WHIRL_TWIN_NATIVE)
  set(whirl_twin_native_option -march=native)
endif()
catkin_package(
  INCLUDE_DIRS src
  LIBRARIES whirl_twin_studies whirl_twin_core
  CATKIN_DEPENDS roscpp std_msgs std_srvs sensor_msgs message_runtime
  CFG_EXTRAS whirl_twin-pluginlib.cmake whirl_twin-extras.cmake)

catkin_add_env_hooks(50.whirl_twin SHELLS bash DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/config/completion)

add_library(whirl_twin_ros INTERFACE)
target_include_directories(whirl_twin_ros SYSTEM INTERFACE ${catkin_INCLUDE_DIRS}
  ${CATKIN_DEVEL_PREFIX}/${CATKIN_GLOBAL_INCLUDE_DESTINATION})
target_link_libraries(whirl_twin_ros INTERFACE ${catkin_LIBRARIES})
add_dependencies(whirl_twin_ros whirl_twin_generate_messages_cpp)
