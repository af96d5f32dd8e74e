# Headers that cost a quarter of the compile time of the firmware's files and the desk tools. CMAKE_DISABLE_PRECOMPILE_HEADERS=ON
# switches the precompiled header off; each file includes what it needs all the same.
file(GENERATE OUTPUT "${CMAKE_CURRENT_BINARY_DIR}/precompiled.cc" CONTENT "")
add_library(godobject_precompiled OBJECT "${CMAKE_CURRENT_BINARY_DIR}/precompiled.cc")
target_link_libraries(godobject_precompiled PRIVATE godobject_core godobject_warnings)
target_precompile_headers(godobject_precompiled PRIVATE
  <algorithm> <filesystem> <functional> <optional> <string> <vector> <Eigen/Geometry>)

# The desk tools' commands read their arguments and call libraries, so -O1 is enough for them, and for the library that
# does what they share. CLI11 costs them most.
find_package(CLI11 REQUIRED)
set(COMMAND_OPTIONS $<$<CONFIG:Release>:-O1>)
add_library(godobject_precompiled_commands OBJECT "${CMAKE_CURRENT_BINARY_DIR}/precompiled.cc")
target_link_libraries(godobject_precompiled_commands PRIVATE godobject_core CLI11::CLI11 godobject_warnings)
target_compile_options(godobject_precompiled_commands PRIVATE ${COMMAND_OPTIONS})
target_precompile_headers(godobject_precompiled_commands PRIVATE
  <algorithm> <filesystem> <functional> <optional> <string> <vector> <CLI/CLI.hpp> <Eigen/Geometry>)

# godobject_precompile_folder(FOLDER)
# Gives a precompiled header to the targets of the folder and of the folders below it. Those of godobject_embedded are
# compiled with other options, and three libraries do not link the core and Eigen.
function(godobject_precompile_folder folder)
  set(tools "${PROJECT_SOURCE_DIR}/toolchain")
  cmake_path(IS_PREFIX tools "${folder}" NORMALIZE is_tool)
  get_property(targets DIRECTORY "${folder}" PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target IN LISTS targets)
    get_target_property(type ${target} TYPE)
    get_target_property(libraries ${target} LINK_LIBRARIES)
    if(target STREQUAL godobject_command_line OR (is_tool AND type STREQUAL EXECUTABLE))
      target_compile_options(${target} PRIVATE ${COMMAND_OPTIONS})
      target_precompile_headers(${target} REUSE_FROM godobject_precompiled_commands)
    elseif(type MATCHES "STATIC_LIBRARY|EXECUTABLE" AND NOT "godobject_embedded" IN_LIST libraries
       AND NOT target MATCHES "^godobject_(parallel|statistics|timing)$")
      target_precompile_headers(${target} REUSE_FROM godobject_precompiled)
    endif()
  endforeach()
  get_property(below DIRECTORY "${folder}" PROPERTY SUBDIRECTORIES)
  foreach(subfolder IN LISTS below)
    godobject_precompile_folder("${subfolder}")
  endforeach()
endfunction()
