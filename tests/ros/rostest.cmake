# whirl_twin_rostest(NAME TRIAL...): one ctest entry rostest_NAME, which runs trials (*_test.py, or a class in one) one after
# the other under one master, on a loopback with a multicast route and nothing else; they start and end their nodes.
#
# A master and rostest take longer than most trials, and rostest starts them for each <test>: so the trials of a group
# share one <test>. No group should take much longer than the others, and one that fails is repeated as a whole; a single
# trial is started as trials.test says.
find_program(ROSTEST rostest REQUIRED)

# What trials start besides nodes.
set(whirl_twin_trial_programs
  WHIRL_TWIN_PROGRAM=$<TARGET_FILE:twin> PD_BY_LCM=$<TARGET_FILE:pd_by_lcm> WHIRL_BY_ROS=$<TARGET_FILE:whirl_by_ros>
  WHIRL_BY_LCM=$<TARGET_FILE:whirl_by_lcm> CSV_TO_LCM=$<TARGET_FILE:csv_to_lcm>)

function(whirl_twin_rostest name)
  list(JOIN ARGN " " trials)
  # Not with --text: rostest then passes whatever the test programs report. A file that ran no test
  # is a failure. The devel space makes the package, its programs and its messages known.
  # ROS_HOSTNAME would outrank ROS_IP.
  add_test(NAME rostest_${name}
    COMMAND ${PROJECT_SOURCE_DIR}/tests/ros/in_private_network
      env -u ROS_HOSTNAME ROS_IP=127.0.0.1 ROS_HOME=${PROJECT_BINARY_DIR}/ros_home/${name}
      ${CATKIN_DEVEL_PREFIX}/env.sh ${ROSTEST} ${CMAKE_CURRENT_SOURCE_DIR}/trials.test "trials:=${trials}")
  set_tests_properties(rostest_${name} PROPERTIES LABELS rostest TIMEOUT 700
    ENVIRONMENT "${whirl_twin_trial_programs}" FAIL_REGULAR_EXPRESSION "TESTS: 0[^0-9]")
  whirl_twin_live(rostest_${name})
endfunction()
