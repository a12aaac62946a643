# Language level, warnings, floating-point rules, and the switches the presets set.
set(CMAKE_CXX_STANDARD 23)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})

option(BURIN_BUILD_TESTS "Build the tests" ON)
option(BURIN_BUILD_BENCH "Build the benchmarks" OFF)
option(BURIN_BUILD_FUZZERS "Build the libFuzzer targets (needs clang)" OFF)
option(BURIN_WARNINGS_ARE_ERRORS "Stop the build at a warning" OFF)
option(BURIN_COVERAGE "Instrument for gcov" OFF)
set(BURIN_SANITIZE "" CACHE STRING "Sanitizers, as -fsanitize= takes them: address,undefined or thread")

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

# Carried by every Burin target.
add_library(burin_options INTERFACE)
target_include_directories(burin_options INTERFACE ${CMAKE_SOURCE_DIR})
target_compile_options(burin_options INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion
  # One rounding a written operation, on every machine: results must not depend on the compiler's choice to fuse.
  -ffp-contract=off)
if(BURIN_WARNINGS_ARE_ERRORS)
  target_compile_options(burin_options INTERFACE -Werror)
endif()
if(BURIN_SANITIZE)
  target_compile_options(burin_options INTERFACE -fsanitize=${BURIN_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(burin_options INTERFACE -fsanitize=${BURIN_SANITIZE})
endif()
if(BURIN_COVERAGE)
  target_compile_options(burin_options INTERFACE --coverage)
  target_link_options(burin_options INTERFACE --coverage)
endif()

find_package(Threads REQUIRED)
find_package(glm REQUIRED)
