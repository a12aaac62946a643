# burin_shaders(TARGET shader...)
# Compiles GLSL from shaders/ to SPIR-V and lets TARGET include it as "shaders/<name>.spv.hpp", which defines
# const uint32_t k_<name with _ for .>[].
find_program(BURIN_GLSLANG glslangValidator REQUIRED)
function(burin_shaders TARGET)
  file(GLOB shared_headers CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/shaders/shared/*.h ${CMAKE_SOURCE_DIR}/shaders/*.glsl)
  foreach(shader IN LISTS ARGN)
    string(REPLACE "." "_" symbol ${shader})
    set(header ${CMAKE_BINARY_DIR}/generated/shaders/${shader}.spv.hpp)
    add_custom_command(OUTPUT ${header}
      COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_BINARY_DIR}/generated/shaders
      COMMAND ${BURIN_GLSLANG} --quiet -V --target-env vulkan1.2 -I${CMAKE_SOURCE_DIR} --vn k_${symbol} -o ${header}
              ${CMAKE_SOURCE_DIR}/shaders/${shader}
      DEPENDS ${CMAKE_SOURCE_DIR}/shaders/${shader} ${shared_headers}
      COMMENT "SPIR-V ${shader}" VERBATIM)
    target_sources(${TARGET} PRIVATE ${header})
  endforeach()
  target_include_directories(${TARGET} SYSTEM PRIVATE ${CMAKE_BINARY_DIR}/generated)
endfunction()
