# What nearly every source reads first is compiled once for all of them (docs/decisions/016-build-time.md). Where the
# sources of a room are compiled as one there is little left to gain, and a cache works better without. Preset ci
# does without too, so that a source that forgets an include does not go unnoticed.
#   burin_precompile(TARGET [tests])   with GoogleTest, for test programs
set(precompile ON)
if(BURIN_ROOM_BUILDS)
  set(precompile OFF)
endif()
option(BURIN_PRECOMPILE "Compile the common headers once for all sources" ${precompile})

function(burin_precompiled_headers NAME)
  if(NOT BURIN_PRECOMPILE)
    return()
  endif()
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/precompiled/${NAME}.cpp CONTENT "" @ONLY)
  add_library(${NAME} OBJECT ${CMAKE_BINARY_DIR}/precompiled/${NAME}.cpp)
  target_link_libraries(${NAME} PRIVATE burin_options Threads::Threads glm::glm nlohmann_json::nlohmann_json)
  target_precompile_headers(${NAME} PRIVATE
    <algorithm> <array> <atomic> <bit> <charconv> <cmath> <cstdint> <cstdio> <cstring> <expected> <filesystem>
    <functional> <limits> <map> <memory> <numbers> <numeric> <optional> <random> <span>
    <string> <string_view> <tuple> <utility> <variant> <vector>
    ${CMAKE_SOURCE_DIR}/base/space.hpp ${CMAKE_SOURCE_DIR}/base/error.hpp ${CMAKE_SOURCE_DIR}/base/json.hpp
    ${ARGN})
endfunction()

function(burin_precompile TARGET)
  if(BURIN_PRECOMPILE)
    set(from burin_precompiled)
    if("tests" IN_LIST ARGN)
      set(from burin_precompiled_tests)
    endif()
    target_precompile_headers(${TARGET} REUSE_FROM ${from})
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
      # GCC 12 forgets that what comes from a precompiled header is the standard library's own, and warns of it
      # (strings that overlap or overflow). Preset ci, without precompiled headers, has these warnings on.
      target_compile_options(${TARGET} PRIVATE -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
    endif()
  endif()
endfunction()
