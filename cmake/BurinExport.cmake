# The CMake package burin: find_package(burin) gives burin::base, geometry, devices, haptics, scene, gpu, compute and
# compute_vulkan, as docs/architecture.md describes these folders, for programs outside of this repository. Headers lie
# in PREFIX/include/burin and are included as here: "compute/cpu_engine.hpp". They are the program's own and promise no
# stability: the package is found by exactly the version that it is of. docs/library.md has an example.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
set(exported base geometry devices haptics scene gpu compute compute/vulkan)
set(place ${CMAKE_INSTALL_LIBDIR}/cmake/burin)

set(targets burin_options burin_shaders_shared)
foreach(folder IN LISTS exported)
  string(REPLACE "/" "_" name ${folder})
  cmake_path(GET folder PARENT_PATH above)
  set_target_properties(burin_${name} PROPERTIES EXPORT_NAME ${name})
  list(APPEND targets burin_${name})
  install(DIRECTORY ${CMAKE_SOURCE_DIR}/${folder} DESTINATION include/burin/${above} COMPONENT development
    FILE_PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ FILES_MATCHING PATTERN "*.hpp" PATTERN "*.h")
endforeach()
set_target_properties(burin_options PROPERTIES EXPORT_NAME options)
set_target_properties(burin_shaders_shared PROPERTIES EXPORT_NAME shaders_shared)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/shaders/shared DESTINATION include/burin/shaders COMPONENT development
  FILE_PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ FILES_MATCHING PATTERN "*.h")
install(TARGETS ${targets} EXPORT burin ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/burin COMPONENT development
  INCLUDES DESTINATION include/burin)
install(EXPORT burin NAMESPACE burin:: DESTINATION ${place} FILE burin-targets.cmake COMPONENT development)
configure_package_config_file(${CMAKE_SOURCE_DIR}/cmake/package/burin-config.cmake.in
  ${CMAKE_BINARY_DIR}/burin-config.cmake INSTALL_DESTINATION ${place})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/burin-config-version.cmake COMPATIBILITY ExactVersion)
install(FILES ${CMAKE_BINARY_DIR}/burin-config.cmake ${CMAKE_BINARY_DIR}/burin-config-version.cmake
  DESTINATION ${place} COMPONENT development)
