# burin_folder(NAME MAY_INCLUDE folder... [EXCEPT file...] [ALONE file...] [LINKS library...])
# One target a folder: burin_NAME (burin_A_B for folder A/B), of all sources in the folder and its rooms (subfolders)
# but those after EXCEPT; those after ALONE are compiled by themselves in every preset (BurinRooms.cmake). MAY_INCLUDE
# is the layer rule of docs/architecture.md; the folders named there are linked, and the test house.layers fails on an
# include of any other.
function(burin_folder NAME)
  cmake_parse_arguments(ARG "" "" "EXCEPT;ALONE;MAY_INCLUDE;LINKS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} *.cpp)
  list(REMOVE_ITEM sources main.cpp ${ARG_EXCEPT})
  string(REPLACE "/" "_" name "${NAME}")
  burin_rooms(sources ${name} SOURCES ${sources} ALONE ${ARG_ALONE})
  add_library(burin_${name} STATIC ${sources})
  burin_precompile(burin_${name})
  target_link_libraries(burin_${name} PUBLIC burin_options Threads::Threads glm::glm ${ARG_LINKS})
  foreach(layer IN LISTS ARG_MAY_INCLUDE)
    string(REPLACE "/" "_" target "${layer}")
    target_link_libraries(burin_${name} PUBLIC burin_${target})
  endforeach()
  string(REPLACE ";" " " allowed "${ARG_MAY_INCLUDE}")
  set_property(GLOBAL APPEND PROPERTY BURIN_LAYER_RULES "${NAME}: ${allowed}")
endfunction()

# burin_test(FOLDER compute KIND unit [SOURCES a_unit.cpp ...] [FOLDERS folder...] [LINKS library...] [RUNS_BURIN]
#            [ONE_THREAD | MANY_THREADS] [STEPPED cases] [PARTS n])
# One program for each folder and kind, of the files *_KIND.cpp in the folder and its rooms that no program before has
# taken, or of SOURCES alone; the ctest name is FOLDER.KIND and the label is KIND. RUNS_BURIN: it starts the program
# on files of assets/ and judges meshes by mesh_audit (tests/support/places.hpp). Each writes
# test-reports/FOLDER.KIND.xml in the build directory, which scripts/test reads for its counts and the reasons of skips.
# ONE_THREAD: what it tests starts no thread, or none but those which another test has; under the thread sanitizer it is
# neither built nor run, since there is nothing to find. MANY_THREADS: whole sessions with a Vulkan device in software,
# which is slow under any sanitizer; built and run under the thread sanitizer alone, the address sanitizer has the other
# programs of kind gpu. Kind golden is run under none: what it compares a sanitizer does not change.
# STEPPED: cases, as a filter of GoogleTest names them, that do ticks, scene and frames one after the other on the
# caller's thread; the thread sanitizer, which has nothing to find there, runs the others alone. Not with PARTS.
# PARTS: its cases are dealt out to n ctests that run side by side, 1.FOLDER.KIND to n.FOLDER.KIND: for cases that wait
# for real time, or whose program would otherwise run on alone at the end.
# Kind realtime runs alone on the machine. Kind soak is random use with a new seed each time, short by default. Kind
# fuzz is a libFuzzer program (no GoogleTest), built by preset fuzz only; its ctest replays tests/FOLDER/corpus and then
# mutates it for a fixed number of runs.
function(burin_test)
  cmake_parse_arguments(ARG "RUNS_BURIN;ONE_THREAD;MANY_THREADS" "FOLDER;KIND;PARTS;STEPPED"
    "SOURCES;ALONE;FOLDERS;LINKS" ${ARGN})
  set(target ${ARG_FOLDER}_${ARG_KIND})
  if(ARG_KIND STREQUAL "fuzz")
    burin_fuzzer(${target} ${ARGN})
    return()
  endif()
  if(NOT ARG_SOURCES)
    file(GLOB_RECURSE ARG_SOURCES CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} *_${ARG_KIND}.cpp)
    get_directory_property(taken BURIN_TAKEN_TESTS)
    list(REMOVE_ITEM ARG_SOURCES ${taken})
  endif()
  set_property(DIRECTORY APPEND PROPERTY BURIN_TAKEN_TESTS ${ARG_SOURCES})
  if((ARG_ONE_THREAD AND BURIN_SANITIZE MATCHES "thread") OR (ARG_MANY_THREADS AND BURIN_SANITIZE MATCHES "address")
     OR (ARG_KIND STREQUAL "golden" AND BURIN_SANITIZE))
    return()
  endif()
  burin_rooms(sources ${target} SOURCES ${ARG_SOURCES} ALONE ${ARG_ALONE})
  add_executable(${target} ${sources})
  set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  target_link_libraries(${target} PRIVATE burin_test_support ${ARG_LINKS})
  if(BURIN_ROOM_BUILDS AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # As for all room builds (BurinRooms.cmake); and fixtures in anonymous namespaces of included texts are no fault.
    target_compile_options(${target} PRIVATE -Wno-maybe-uninitialized -Wno-subobject-linkage)
  endif()
  if(BURIN_TESTS_OPTIMISED_BY)
    target_compile_options(${target} PRIVATE ${BURIN_TESTS_OPTIMISED_BY})
  endif()
  burin_precompile(${target} tests)
  foreach(folder IN LISTS ARG_FOLDERS)
    target_link_libraries(${target} PRIVATE burin_${folder})
  endforeach()
  if(ARG_RUNS_BURIN)
    add_dependencies(${target} burin mesh_audit burin_posing_layer)
  endif()
  if(NOT ARG_PARTS)
    burin_add_test(${ARG_FOLDER}.${ARG_KIND} ${target} ${ARG_KIND})
    if(ARG_STEPPED AND BURIN_SANITIZE MATCHES "thread")
      set_tests_properties(${ARG_FOLDER}.${ARG_KIND} PROPERTIES ENVIRONMENT "BURIN_TEST_LEAVES_OUT=${ARG_STEPPED}")
    endif()
    return()
  endif()
  math(EXPR last "${ARG_PARTS} - 1")
  foreach(part RANGE ${last})
    math(EXPR number "${part} + 1")
    burin_add_test(${number}.${ARG_FOLDER}.${ARG_KIND} ${target} ${ARG_KIND})
    set_tests_properties(${number}.${ARG_FOLDER}.${ARG_KIND} PROPERTIES
      ENVIRONMENT "GTEST_TOTAL_SHARDS=${ARG_PARTS};GTEST_SHARD_INDEX=${part}")
  endforeach()
endfunction()

# Called by burin_test: the ctest TEST, which runs TARGET with a bound of time.
function(burin_add_test TEST TARGET KIND)
  burin_test_needs(${TEST} ${TARGET})
  add_test(NAME ${TEST} COMMAND ${TARGET} --gtest_output=xml:${CMAKE_BINARY_DIR}/test-reports/${TEST}.xml
    WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
  set_tests_properties(${TEST} PROPERTIES LABELS ${KIND} TIMEOUT ${BURIN_TEST_TIMEOUT_S})
  if(KIND STREQUAL "soak")  # as long as its user wants it to run
    set_tests_properties(${TEST} PROPERTIES TIMEOUT 14400)
  endif()
  if(KIND STREQUAL "gpu")  # they take longest: begun first, none of them runs on alone at the end
    set_tests_properties(${TEST} PROPERTIES COST 100)
  endif()
  if(KIND STREQUAL "realtime")
    set_tests_properties(${TEST} PROPERTIES RUN_SERIAL ON)
  endif()
endfunction()

# burin_test_needs(TEST target...)  names what ctest TEST runs. scripts/test --only builds just that, as listed
# in build/PRESET/test-targets.txt. burin_test calls it; tests that are added otherwise call it themselves.
function(burin_test_needs TEST)
  string(REPLACE ";" " " targets "${ARGN}")
  file(APPEND ${CMAKE_BINARY_DIR}/test-targets.txt "${TEST} ${targets}\n")
endfunction()

# Called by burin_test for kind fuzz.
function(burin_fuzzer TARGET)
  if(NOT BURIN_BUILD_FUZZERS)
    return()
  endif()
  cmake_parse_arguments(ARG "" "FOLDER;KIND" "SOURCES;FOLDERS;LINKS" ${ARGN})
  add_executable(${TARGET} ${ARG_SOURCES})
  set_target_properties(${TARGET} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  target_link_libraries(${TARGET} PRIVATE burin_options ${ARG_LINKS})
  target_link_options(${TARGET} PRIVATE -fsanitize=fuzzer)
  foreach(folder IN LISTS ARG_FOLDERS)
    target_link_libraries(${TARGET} PRIVATE burin_${folder})
  endforeach()
  # libFuzzer writes what it finds into the first folder, so the tracked corpus comes second.
  set(corpus ${CMAKE_BINARY_DIR}/corpus/${ARG_FOLDER})
  file(MAKE_DIRECTORY ${corpus})
  if(IS_DIRECTORY ${CMAKE_SOURCE_DIR}/tests/${ARG_FOLDER}/corpus)
    list(APPEND corpus ${CMAKE_SOURCE_DIR}/tests/${ARG_FOLDER}/corpus)
  endif()
  burin_test_needs(${ARG_FOLDER}.fuzz ${TARGET})
  add_test(NAME ${ARG_FOLDER}.fuzz COMMAND ${TARGET} -seed=1 -runs=100000 -timeout=10 -rss_limit_mb=2048 ${corpus}
    WORKING_DIRECTORY ${CMAKE_BINARY_DIR})
  set_tests_properties(${ARG_FOLDER}.fuzz PROPERTIES LABELS fuzz TIMEOUT ${BURIN_TEST_TIMEOUT_S})
endfunction()
