# Finds what the Python package is built with: pybind11, and the Python that it is for.
if(NOT Python3_EXECUTABLE)
  # Debian's modules, NumPy among them, belong to Debian's Python, which need not be the first on PATH.
  set(Python3_EXECUTABLE /usr/bin/python3)
  if(PYTHON_EXECUTABLE)
    set(Python3_EXECUTABLE ${PYTHON_EXECUTABLE})
  endif()
endif()
find_package(Python3 QUIET COMPONENTS Interpreter Development.Module)
if(Python3_Development.Module_FOUND)
  find_package(pybind11 2.10 QUIET)
endif()
if(WHIRL_TWIN_SANITIZE OR CMAKE_CROSSCOMPILING)  # the Python that is found would have to load a sanitizer first
  set(pybind11_FOUND OFF)
endif()
optional_part(WHIRL_TWIN_PYTHON pybind11_FOUND "Build the Python package (pybind11)")
if(WHIRL_TWIN_PYTHON AND NOT pybind11_FOUND)
  message(FATAL_ERROR "pybind11 was not found: run scripts/setup --python, or configure with -DWHIRL_TWIN_PYTHON=OFF")
endif()

# Where the package is before it is installed, and where it is installed: beside the messages of ROS.
if(WHIRL_TWIN_ROS)
  set(whirl_twin_python_devel ${CATKIN_DEVEL_PREFIX}/${CATKIN_GLOBAL_PYTHON_DESTINATION}/whirl_twin)
  set(whirl_twin_python_dir ${CATKIN_GLOBAL_PYTHON_DESTINATION}/whirl_twin)
else()
  set(whirl_twin_python_devel ${PROJECT_BINARY_DIR}/python/whirl_twin)
  set(whirl_twin_python_dir lib/python3/dist-packages/whirl_twin)
endif()
