# What another project gets: headers under include/godobject/core, the library, and find_package(godobject) with the
# target godobject::core, so that it writes #include "godobject/god_object.h" as this one does.
include(CMakePackageConfigHelpers)

set(GODOBJECT_CMAKE_DIR "${CMAKE_INSTALL_LIBDIR}/cmake/godobject")

install(TARGETS godobject_core EXPORT godobject ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT core)
install(DIRECTORY core DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/godobject" COMPONENT core
  FILES_MATCHING PATTERN "*.h")
install(EXPORT godobject NAMESPACE godobject:: FILE godobjectTargets.cmake DESTINATION "${GODOBJECT_CMAKE_DIR}"
  COMPONENT core)

configure_package_config_file(toolchain/cmake/godobjectConfig.cmake.in
  "${CMAKE_BINARY_DIR}/godobjectConfig.cmake" INSTALL_DESTINATION "${GODOBJECT_CMAKE_DIR}")
write_basic_package_version_file("${CMAKE_BINARY_DIR}/godobjectConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_BINARY_DIR}/godobjectConfig.cmake" "${CMAKE_BINARY_DIR}/godobjectConfigVersion.cmake"
  DESTINATION "${GODOBJECT_CMAKE_DIR}" COMPONENT core)
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT core)
