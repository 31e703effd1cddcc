# whirl_twin_rostest(NAME FILE.test [SOURCES FILE...] [LIBRARIES LIB...] [DEPENDENCIES TARGET...])
#
# One ctest entry rostest_NAME: the launch file FILE.test run by rostest, with a master, a loopback
# and a multicast route of its own. A SOURCES list is built into the gtest program NAME, which the
# launch file starts as <test test-name="NAME" pkg="whirl_twin" type="NAME"/>; it has its own main, for
# ros::init. The target rostest_NAME builds that program and the DEPENDENCIES, the nodes that the
# launch file starts.
find_program(ROSTEST rostest REQUIRED)

function(whirl_twin_rostest name file)
  cmake_parse_arguments(rostest "" "" "SOURCES;LIBRARIES;DEPENDENCIES" ${ARGN})
  get_filename_component(file ${file} ABSOLUTE)
  add_custom_target(rostest_${name})
  if(rostest_DEPENDENCIES)
    add_dependencies(rostest_${name} ${rostest_DEPENDENCIES})
  endif()
  if(rostest_SOURCES)
    add_executable(${name} ${rostest_SOURCES})
    target_link_libraries(${name} PRIVATE whirl_twin_core whirl_twin_ros whirl_twin_warnings
      ${rostest_LIBRARIES} GTest::gtest)
    target_precompile_headers(${name} REUSE_FROM whirl_twin_ros_headers)
    add_dependencies(rostest_${name} ${name})
  endif()
  # Not with --text: rostest then passes whatever the test programs report. A file that ran no test
  # is a failure. The devel space makes the package, its programs and its messages known.
  # ROS_HOSTNAME would outrank ROS_IP.
  add_test(NAME rostest_${name}
    COMMAND ${PROJECT_SOURCE_DIR}/tests/ros/in_private_network
      env -u ROS_HOSTNAME ROS_IP=127.0.0.1 ROS_HOME=${PROJECT_BINARY_DIR}/ros_home/${name}
      ${CATKIN_DEVEL_PREFIX}/env.sh ${ROSTEST} ${file})
  set_tests_properties(rostest_${name} PROPERTIES LABELS rostest RESOURCE_LOCK live COST 100 TIMEOUT 120
    FAIL_REGULAR_EXPRESSION "TESTS: 0[^0-9]")
endfunction()
