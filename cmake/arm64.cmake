# Cross-building for 64-bit ARM: -DCMAKE_TOOLCHAIN_FILE=cmake/arm64.cmake
# -DWHIRL_TWIN_ARM64_LIBRARIES=<folder with the usr/ of Debian's arm64 packages>. scripts/arm64 does it. Programs
# of the build, its tests, run under QEMU's emulation of the processor.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_CXX_FLAGS_INIT -Wno-psabi)  # no word on how older compilers pass arguments
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64-static;-L;/usr/aarch64-linux-gnu)

list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES WHIRL_TWIN_ARM64_LIBRARIES)
set(CMAKE_FIND_ROOT_PATH ${WHIRL_TWIN_ARM64_LIBRARIES} /usr/aarch64-linux-gnu)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
include_directories(SYSTEM ${WHIRL_TWIN_ARM64_LIBRARIES}/usr/include)
