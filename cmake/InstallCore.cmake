# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT

# `cmake --install BUILD --component core`: the core's library and headers, and what find_package(mapscore)
# reads. Headers include each other as "core/...", so they lie in include/mapscore/core.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/mapscore)
target_include_directories(mapscore_core INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/mapscore>)
install(TARGETS mapscore_core EXPORT mapscore_targets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT core)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/core DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/mapscore COMPONENT core
        FILES_MATCHING PATTERN *.hpp)
install(EXPORT mapscore_targets FILE mapscore-targets.cmake NAMESPACE mapscore::
        DESTINATION ${package_folder} COMPONENT core)

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/mapscore-config.cmake.in
                              ${PROJECT_BINARY_DIR}/mapscore-config.cmake INSTALL_DESTINATION ${package_folder}
                              NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/mapscore-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/mapscore-config.cmake ${PROJECT_BINARY_DIR}/mapscore-config-version.cmake
        DESTINATION ${package_folder} COMPONENT core)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT core)
