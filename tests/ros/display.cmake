foreach(test display_test mechanism_display_test display_text_test)
  whirl_twin_test(${test} ${CMAKE_CURRENT_LIST_DIR}/${test}.cpp
    LIBRARIES whirl_twin_display whirl_twin_ros)
endforeach()
