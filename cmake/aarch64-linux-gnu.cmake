# Builds for 64-bit ARM on another Debian machine: cmake --toolchain cmake/aarch64-linux-gnu.cmake, with the environment
# variable ALLPAIRS_SYSROOT naming the folder that Debian's arm64 packages are unpacked in. Programs run under qemu-aarch64.

set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)

# The compiler brings the C and C++ libraries; what else there is lies in the unpacked packages.
set(CMAKE_FIND_ROOT_PATH "$ENV{ALLPAIRS_SYSROOT}" /usr/aarch64-linux-gnu)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)

set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64 -L /usr/aarch64-linux-gnu -E
                                  "LD_LIBRARY_PATH=$ENV{ALLPAIRS_SYSROOT}/usr/lib/aarch64-linux-gnu")
