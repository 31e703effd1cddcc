foreach(test display_test mechanism_display_test display_text_test instruments_test layout_test)
  whirl_twin_test(${test} ${CMAKE_CURRENT_LIST_DIR}/${test}.cpp
    LIBRARIES whirl_twin_display whirl_twin_ros)
endforeach()
target_compile_definitions(layout_test PRIVATE
  WHIRL_TWIN_RVIZ_CONFIG="${PROJECT_SOURCE_DIR}/config/rviz/demo.rviz")
target_sources(display_test PRIVATE ${CMAKE_CURRENT_LIST_DIR}/shaft_display_test.cpp)
