whirl_twin_tests(display SHARDS 1 BATCH 6 LIBRARIES whirl_twin_display whirl_twin_ros SOURCES
  display_test.cpp display_text_test.cpp instruments_test.cpp layout_test.cpp mechanism_display_test.cpp
  shaft_display_test.cpp)
target_compile_definitions(display_tests PRIVATE WHIRL_TWIN_RVIZ_CONFIG="${PROJECT_SOURCE_DIR}/config/rviz/demo.rviz")
