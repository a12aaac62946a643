# Room builds: the sources of a folder, its rooms (subfolders) included, are compiled a few dozen at a time as one text,
# since most of a source's time goes into headers that its neighbours read too (docs/decisions/016-build-time.md). So a
# name in an anonymous namespace is unique within its folder and all rooms of it. A forgotten include, which a neighbour
# has read already, is found by the test house.includes, and by preset dev, which compiles each source alone.
#   burin_rooms(RESULT NAME SOURCES source... [ALONE source...])
# Sets RESULT to what is compiled for these sources, whose paths are relative to the current folder: texts
# build/rooms/NAME/NUMBER.cpp that include the sources, and the sources after ALONE, which have compile options of their
# own. The texts name sources from the repository's root, so that they are the same in every clone, as ccache asks.
option(BURIN_ROOM_BUILDS "Compile the sources of a room as one" ON)
if(BURIN_ROOM_BUILDS AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # It sees through std::variant's moves in so long a text, and then takes them for reads of other alternatives. Preset
  # dev keeps the warning.
  target_compile_options(burin_options INTERFACE $<BUILD_INTERFACE:-Wno-maybe-uninitialized>)
endif()

# A text includes sources of about so many bytes together. Short ones are compiled anew quickly when one source changes,
# and are spread well over the cores. Long ones read the headers less often, and are better where everything is
# compiled.
set(BURIN_BYTES_TOGETHER 150000 CACHE STRING "Bytes of sources that are compiled as one")

function(burin_rooms RESULT NAME)
  cmake_parse_arguments(ARG "" "" "SOURCES;ALONE" ${ARGN})
  file(RELATIVE_PATH here ${CMAKE_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  if(NOT BURIN_ROOM_BUILDS)
    set(${RESULT} ${ARG_SOURCES} PARENT_SCOPE)
    return()
  endif()
  set(compiled)
  set(texts)
  set(bytes 0)
  foreach(source IN LISTS ARG_SOURCES)
    if(source IN_LIST ARG_ALONE OR IS_ABSOLUTE "${source}" OR NOT source MATCHES "\\.cpp$")
      list(APPEND compiled ${source})
      continue()
    endif()
    file(SIZE ${CMAKE_CURRENT_SOURCE_DIR}/${source} size)
    math(EXPR bytes "${bytes} + ${size}")
    math(EXPR number "${bytes} / ${BURIN_BYTES_TOGETHER}")
    set(text ${CMAKE_BINARY_DIR}/rooms/${NAME}/${number}.cpp)
    list(APPEND texts ${text})
    string(APPEND content_${number} "#include \"${here}/${source}\"\n")
    set(content_of_${text} content_${number})
  endforeach()
  list(REMOVE_DUPLICATES texts)
  foreach(text IN LISTS texts)
    file(CONFIGURE OUTPUT ${text} CONTENT "${${content_of_${text}}}" @ONLY)
  endforeach()
  set(${RESULT} ${compiled} ${texts} PARENT_SCOPE)
endfunction()
