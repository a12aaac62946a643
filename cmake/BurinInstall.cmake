# What `cmake --install` puts where, and what scripts/package makes of it (CPack). The program finds its assets by its
# own place (base/assets.hpp): PREFIX/share/burin, and in the build folder by the link made here.
#   component program       what a user runs: program, assets, rules for udev, manual, completion, desktop's files
#   component development   headers, libraries and the CMake package (BurinExport.cmake)
include(GNUInstallDirs)
# As in every build and by every user, whatever the umask: packages of one commit have the same bytes.
set(CMAKE_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
  WORLD_EXECUTE)
set(data share)  # not CMAKE_INSTALL_DATADIR: the program looks in PREFIX/share/burin
set(files cmake/package)

file(CREATE_LINK ${CMAKE_SOURCE_DIR}/assets ${CMAKE_BINARY_DIR}/assets SYMBOLIC)

install(TARGETS burin RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
# Two folders below lib, as the program looks for them (devices/drivers/library_beside.hpp): CPack takes what is one
# folder below for libraries of the system, and has ldconfig run.
install(TARGETS burin_emulated_hd burin_emulated_dhd burin_emulated_hil LIBRARY DESTINATION lib/burin/emulators
  COMPONENT program)
# What made an asset stays with the sources; licences stand in doc/burin/copyright.
install(DIRECTORY assets/ DESTINATION ${data}/burin COMPONENT program
  FILE_PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ PATTERN "*.py" EXCLUDE PATTERN "LICENSE*" EXCLUDE)
install(FILES assets/devices/70-burin-devices.rules DESTINATION lib/udev/rules.d COMPONENT program)
install(FILES ${files}/burin.desktop DESTINATION ${data}/applications COMPONENT program)
install(FILES ${files}/burin.svg DESTINATION ${data}/icons/hicolor/scalable/apps COMPONENT program)
install(FILES ${files}/burin.xml DESTINATION ${data}/mime/packages COMPONENT program)
install(FILES ${files}/burin.metainfo.xml DESTINATION ${data}/metainfo RENAME io.github.burin.Burin.metainfo.xml
  COMPONENT program)
install(FILES ${files}/copyright DESTINATION ${data}/doc/burin COMPONENT program)
# Messages and helps name docs/formats.md and others: they are found from doc/burin as from the sources' root.
install(FILES README.md DESTINATION ${data}/doc/burin COMPONENT program)
install(DIRECTORY docs DESTINATION ${data}/doc/burin COMPONENT program
  FILE_PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)

# Manual, completion and changelog are made as the program is installed: by itself, from its own help.
set(BURIN_MAINTAINER "The Burin authors <burin@users.noreply.github.com>" CACHE STRING "Who answers for the package")
set(made ${CMAKE_BINARY_DIR}/package)
install(CODE "
  set(burin \"$<TARGET_FILE:burin>\")
  set(sources \"${CMAKE_SOURCE_DIR}\")
  set(made \"${made}\")
  set(maintainer \"${BURIN_MAINTAINER}\")
  include(\"${CMAKE_SOURCE_DIR}/cmake/BurinManual.cmake\")" COMPONENT program)
install(DIRECTORY ${made}/man/ DESTINATION ${data}/man/man1 COMPONENT program)
install(FILES ${made}/bash/burin DESTINATION ${data}/bash-completion/completions COMPONENT program)
install(FILES ${made}/changelog.gz DESTINATION ${data}/doc/burin COMPONENT program)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME burin)
set(CPACK_PACKAGE_CONTACT ${BURIN_MAINTAINER})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME burin)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Loaded at run time, so that dpkg-shlibdeps does not see them: Vulkan's loader and a driver for it.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libvulkan1, mesa-vulkan-drivers | vulkan-icd")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "fonts-roboto-unhinted, udev")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "immersive haptic workbench")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION [[
Carve, fill, paint and smooth solids with a force-feedback stylus, a wand, a
glove or a mouse, before a stereo wall or in a window. Explore worlds by
touch, run studies, and keep every tick of them.
.
All of it runs without any device and without a graphics card: devices and
hands can be simulated, and Vulkan can be software.]])
include(CPack)
