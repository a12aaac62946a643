# Language level, warnings, floating-point rules, and the switches the presets set.
set(CMAKE_CXX_STANDARD 23)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})

option(BURIN_BUILD_TESTS "Build the tests" ON)
option(BURIN_WITH_PEERS
  "Build the benchmarks' peers: OpenVDB, CGAL, OpenSceneGraph and VTK (scripts/setup --peers)" OFF)
option(BURIN_BUILD_FUZZERS "Build the libFuzzer targets (needs clang)" OFF)
option(BURIN_WARNINGS_ARE_ERRORS "Stop the build at a warning" OFF)
set(BURIN_TESTS_OPTIMISED_BY "" CACHE STRING "A compile option of the tests alone, such as -O1 for a faster build")
option(BURIN_COVERAGE "Instrument for gcov" OFF)
set(BURIN_SANITIZE "" CACHE STRING "Sanitizers, as -fsanitize= takes them: address,undefined or thread")
set(BURIN_SANITIZE_WITHOUT "" CACHE STRING "Checks of these sanitizers that are left out, as -fno-sanitize= takes them")

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

# Carried by every Burin target.
add_library(burin_options INTERFACE)
target_include_directories(burin_options INTERFACE $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}>)
# Who links an installed library keeps the rules of arithmetic, and has warnings of their own.
target_compile_features(burin_options INTERFACE cxx_std_23)
target_compile_options(burin_options INTERFACE
  $<BUILD_INTERFACE:-Wall> $<BUILD_INTERFACE:-Wextra> $<BUILD_INTERFACE:-Wpedantic> $<BUILD_INTERFACE:-Wconversion>
  # One rounding a written operation, on every machine: results must not depend on the compiler's choice to fuse.
  -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC 12 sees overlapping copies in "literal" + std::string where there are none (its bug 105651, fixed in 13).
  target_compile_options(burin_options INTERFACE $<BUILD_INTERFACE:-Wno-restrict>)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC 12 at -O2 turns dvec3(vec3(x)) into x: its SLP vectorizer forgets that the way through float rounds.
  # tests/base/space_unit.cpp shows it.
  target_compile_options(burin_options INTERFACE -fno-tree-slp-vectorize)
endif()
if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  # libstdc++ 12 asks for std::get_temporary_buffer itself, within std::stable_sort.
  target_compile_options(burin_options INTERFACE -Wno-deprecated-declarations)
endif()
if(BURIN_WARNINGS_ARE_ERRORS)
  target_compile_options(burin_options INTERFACE $<BUILD_INTERFACE:-Werror>)
endif()
if(BURIN_SANITIZE)
  target_compile_options(burin_options INTERFACE -fsanitize=${BURIN_SANITIZE} -fno-omit-frame-pointer
    -fno-sanitize-recover=all)
  if(BURIN_SANITIZE_WITHOUT)
    target_compile_options(burin_options INTERFACE -fno-sanitize=${BURIN_SANITIZE_WITHOUT})
  endif()
  target_link_options(burin_options INTERFACE -fsanitize=${BURIN_SANITIZE})
endif()
if(BURIN_BUILD_FUZZERS)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "BURIN_BUILD_FUZZERS needs clang: cmake --preset fuzz (scripts/setup --dev installs it)")
  endif()
  target_compile_options(burin_options INTERFACE -fsanitize=fuzzer-no-link)
endif()
if(BURIN_COVERAGE)
  target_compile_options(burin_options INTERFACE --coverage)
  target_link_options(burin_options INTERFACE --coverage)
endif()

# A test that hangs is stopped after this long. It guards the run; no test measures against it.
set(BURIN_TEST_TIMEOUT_S 900)
if(BURIN_SANITIZE OR BURIN_COVERAGE OR CMAKE_BUILD_TYPE STREQUAL "Debug")
  set(BURIN_TEST_TIMEOUT_S 1800)
endif()

find_package(Threads REQUIRED)
find_package(glm REQUIRED)
find_package(nlohmann_json REQUIRED)
