# A compiler cache and a fast linker where they are installed (scripts/setup installs both). The cache is set up so that
# every clone and work tree of this repository, and every preset in it, shares what has been compiled before:
#   base_dir, hash_dir    paths below the repository are taken as relative ones, so another clone asks the same question
#   sloppiness            a header counts by its text, not by when it was written
#   LC_ALL                the language of the compiler's messages is part of the question: that of scripts/common.sh, so
#                         that what a shell has built counts for the scripts too
# Set in the environment, CCACHE_DISABLE=1 compiles everything anew.
option(BURIN_CACHE "Compile through ccache where it is installed" ON)
option(BURIN_FAST_LINKER "Link with mold where it is installed" ON)

find_program(BURIN_CCACHE ccache)
if(BURIN_CACHE AND BURIN_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env LC_ALL=C.UTF-8
    CCACHE_BASEDIR=${CMAKE_SOURCE_DIR} CCACHE_NOHASHDIR=1
    CCACHE_SLOPPINESS=include_file_mtime,include_file_ctime,pch_defines,time_macros ${BURIN_CCACHE})
elseif(NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # What the cache does by its base_dir: a program names no folder in which it was built (__FILE__), and is the same,
  # byte for byte, whether it came from the cache or not.
  file(RELATIVE_PATH sources ${CMAKE_BINARY_DIR} ${CMAKE_SOURCE_DIR})
  string(REGEX REPLACE "/$" "" sources ${sources})
  add_compile_options(-ffile-prefix-map=${CMAKE_SOURCE_DIR}=${sources})
endif()

find_program(BURIN_MOLD mold)
if(BURIN_FAST_LINKER AND BURIN_MOLD)
  add_link_options(-fuse-ld=mold)
endif()
