# Installs the library for other projects: the public headers as <godobject/...>, the archive, and find_package(godobject)
# with the target godobject::core.
include(CMakePackageConfigHelpers)

set(GODOBJECT_CMAKE_DIR "${CMAKE_INSTALL_LIBDIR}/cmake/godobject")

install(TARGETS godobject_core EXPORT godobject ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT core)
install(DIRECTORY core/include/godobject DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT core
  FILES_MATCHING PATTERN "*.h")
install(EXPORT godobject NAMESPACE godobject:: FILE godobjectTargets.cmake DESTINATION "${GODOBJECT_CMAKE_DIR}"
  COMPONENT core)

configure_package_config_file(toolchain/cmake/godobjectConfig.cmake.in
  "${PROJECT_BINARY_DIR}/godobjectConfig.cmake" INSTALL_DESTINATION "${GODOBJECT_CMAKE_DIR}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/godobjectConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/godobjectConfig.cmake" "${PROJECT_BINARY_DIR}/godobjectConfigVersion.cmake"
  DESTINATION "${GODOBJECT_CMAKE_DIR}" COMPONENT core)
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT core)
