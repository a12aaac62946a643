# Run by `cmake --install`: makes in ${made} the manual's pages and bash's completion by the program ${burin}, and a
# changelog as Debian has it. The same for every build of a commit: no page tells a date, and gzip no name and no time.
# Takes: burin, sources, made, maintainer. The changelog's time is SOURCE_DATE_EPOCH, or the commit's, or now.
function(run_or_stop)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${sources} RESULT_VARIABLE failed ERROR_VARIABLE said)
  if(NOT failed EQUAL 0)
    string(JOIN " " command ${ARGN})
    message(FATAL_ERROR "${command}: ${said}")
  endif()
endfunction()

file(REMOVE_RECURSE ${made}/man ${made}/bash ${made}/changelog.gz)
# In the sources' folder the help names assets as assets/..., whatever the folder's own name is.
run_or_stop(${burin} --write-manual ${made})
file(GLOB pages ${made}/man/*.1)
foreach(page IN LISTS pages)
  run_or_stop(gzip -9n ${page})
endforeach()

if(NOT DEFINED ENV{SOURCE_DATE_EPOCH})
  execute_process(COMMAND git -C ${sources} log -1 --format=%ct OUTPUT_VARIABLE time OUTPUT_STRIP_TRAILING_WHITESPACE
    RESULT_VARIABLE failed ERROR_QUIET)
  if(failed EQUAL 0 AND time)
    set(ENV{SOURCE_DATE_EPOCH} ${time})
  endif()
endif()
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
execute_process(COMMAND ${burin} --version OUTPUT_VARIABLE said)
string(REGEX MATCH "^burin ([^\n]+)" version "${said}")
set(version ${CMAKE_MATCH_1})
# The newest release of CHANGELOG.md: its lines from the first bullet on.
file(READ ${sources}/CHANGELOG.md changes)
string(REPLACE ";" "," changes "${changes}")
string(REGEX MATCH "\n## [^\n]*\n(.*)$" newest "${changes}")
set(newest ${CMAKE_MATCH_1})
string(REGEX REPLACE "\n## .*$" "" newest "${newest}")
string(REGEX MATCH "- .*$" newest "${newest}")
string(STRIP "${newest}" newest)
string(REGEX REPLACE "(^|\n)- " "\\1* " newest "${newest}")
string(REPLACE "\n" "\n  " newest "${newest}")
file(WRITE ${made}/changelog
  "burin (${version}) unstable; urgency=medium\n\n  ${newest}\n\n -- ${maintainer}  ${date}\n")
run_or_stop(gzip -9n ${made}/changelog)
