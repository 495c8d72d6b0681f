# A toolchain: programs for 64-bit ARM (NEON), made on any machine, run by QEMU. Debian packages g++-aarch64-linux-gnu
# and qemu-user. Linked statically, so that QEMU needs no libraries of that machine.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64)

set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
