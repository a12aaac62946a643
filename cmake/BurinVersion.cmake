# burin_version: the text of this build's version, as burin --version and a package name it (version_text.hpp):
#   0.2.0                         of a commit with the tag v0.2.0
#   0.2.0+14.gHASH                14 commits later
#   0.1.0+20261128.gHASH          without a tag, as in a shallow clone: project()'s release, the commit's day
#   0.1.0                         without git
# It is written when HEAD or a tag moves, into one short source: no other is compiled anew.
#   cmake -D VERSION=0.1.0 -D OUT=FILE -P cmake/BurinVersion.cmake   writes FILE
if(CMAKE_SCRIPT_MODE_FILE)
  get_filename_component(sources ${CMAKE_CURRENT_LIST_DIR} DIRECTORY)
  function(ask_git RESULT)
    execute_process(COMMAND git -C ${sources} ${ARGN} OUTPUT_VARIABLE said ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE
      RESULT_VARIABLE failed)
    if(failed)
      set(said "")
    endif()
    set(${RESULT} "${said}" PARENT_SCOPE)
  endfunction()
  set(ENV{TZ} UTC)
  ask_git(top rev-parse --show-toplevel)
  file(REAL_PATH ${sources} real_sources)
  set(text ${VERSION})
  if(top STREQUAL real_sources)  # not a copy of the sources within somebody's repository
    ask_git(described describe --tags --match "v[0-9]*" --abbrev=8)
    ask_git(commit log -1 --format=%cd.g%h --abbrev=8 --date=format-local:%Y%m%d)
    if(described MATCHES "^v(.*)-([0-9]+)-(g[0-9a-f]+)$")
      set(text ${CMAKE_MATCH_1}+${CMAKE_MATCH_2}.${CMAKE_MATCH_3})
    elseif(described)
      string(SUBSTRING ${described} 1 -1 text)
    elseif(commit)
      set(text ${VERSION}+${commit})
    endif()
  endif()
  file(CONFIGURE OUTPUT ${OUT} @ONLY CONTENT [[
#include "app/cli/version_report.hpp"

namespace burin::app {

std::string version_text() { return "@text@"; }

}  // namespace burin::app
]])
  file(TOUCH_NOCREATE ${OUT})
  return()
endif()

set(moved)
find_package(Git QUIET)
if(GIT_FOUND)
  foreach(part logs/HEAD HEAD refs/tags packed-refs)
    execute_process(COMMAND ${GIT_EXECUTABLE} -C ${CMAKE_SOURCE_DIR} rev-parse --git-path ${part} OUTPUT_VARIABLE path
      OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    get_filename_component(path "${path}" ABSOLUTE BASE_DIR ${CMAKE_SOURCE_DIR})
    if(NOT path STREQUAL CMAKE_SOURCE_DIR AND EXISTS ${path})
      list(APPEND moved ${path})
    endif()
  endforeach()
endif()
set(version_source ${CMAKE_BINARY_DIR}/generated/app/version_text.cpp)
add_custom_command(OUTPUT ${version_source}
  COMMAND ${CMAKE_COMMAND} -D VERSION=${PROJECT_VERSION} -D OUT=${version_source}
          -P ${CMAKE_SOURCE_DIR}/cmake/BurinVersion.cmake
  DEPENDS ${moved} ${CMAKE_SOURCE_DIR}/cmake/BurinVersion.cmake COMMENT "the version by git" VERBATIM)
