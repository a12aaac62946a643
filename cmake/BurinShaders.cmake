# burin_shaders(TARGET [EXACT] shader...)
# Compiles GLSL from shaders/ to SPIR-V and lets TARGET include it as "shaders/<name>.spv.hpp", which defines
# const uint32_t k_<name with _ for .>[]. EXACT: no float operation may be fused with another (cmake/no-contraction),
# and quotients and roots of floats are computed in doubles (BURIN_EXACT, shaders/shared/portable.h).
find_program(BURIN_GLSLANG glslangValidator REQUIRED)
function(burin_shaders TARGET)
  cmake_parse_arguments(ARG "EXACT" "" "" ${ARGN})
  file(GLOB shared_headers CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/shaders/shared/*.h ${CMAKE_SOURCE_DIR}/shaders/*.glsl)
  foreach(shader IN LISTS ARG_UNPARSED_ARGUMENTS)
    string(REPLACE "." "_" symbol ${shader})
    set(header ${CMAKE_BINARY_DIR}/generated/shaders/${shader}.spv.hpp)
    set(glslang ${BURIN_GLSLANG} --quiet -V --target-env vulkan1.2 -I${CMAKE_SOURCE_DIR})
    set(compile COMMAND ${glslang} --vn k_${symbol} -o ${header} ${CMAKE_SOURCE_DIR}/shaders/${shader})
    if(ARG_EXACT)
      set(compile COMMAND ${glslang} -DBURIN_EXACT -o ${header}.spv ${CMAKE_SOURCE_DIR}/shaders/${shader}
        COMMAND ${CMAKE_SOURCE_DIR}/cmake/no-contraction ${header}.spv k_${symbol} ${header})
    endif()
    add_custom_command(OUTPUT ${header}
      COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_BINARY_DIR}/generated/shaders
      ${compile}
      DEPENDS ${CMAKE_SOURCE_DIR}/shaders/${shader} ${shared_headers} ${CMAKE_SOURCE_DIR}/cmake/no-contraction
      COMMENT "SPIR-V ${shader}" VERBATIM)
    list(APPEND headers ${header})
  endforeach()
  # A target of its own, which waits for no library: what a build folder remembers of who read a shader before it moved
  # from one target to another then makes no circle.
  add_custom_target(${TARGET}_shaders DEPENDS ${headers})
  add_dependencies(${TARGET} ${TARGET}_shaders)
  target_include_directories(${TARGET} SYSTEM PRIVATE ${CMAKE_BINARY_DIR}/generated)
endfunction()
