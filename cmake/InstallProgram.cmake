# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT

# `cmake --install BUILD --component program`, beside the component core: the libraries of all rooms and of the verbs,
# from which mapscore_add_program (ProgramTargets.cmake) links a program of somebody else's.
get_property(rooms GLOBAL PROPERTY mapscore_rooms)
install(TARGETS ${rooms} mapscore_sim mapscore_eval mapscore_cli EXPORT mapscore_program_targets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT program)
install(EXPORT mapscore_program_targets FILE mapscore-program-targets.cmake NAMESPACE mapscore::
        DESTINATION ${package_folder} COMPONENT program)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/mapscore-program.cmake @ONLY CONTENT
"set(mapscore_simulator \"@MAPSCORE_SIMULATOR@\")
include(\${CMAKE_CURRENT_LIST_DIR}/AddProgram.cmake)
")
install(FILES ${PROJECT_BINARY_DIR}/mapscore-program.cmake ${PROJECT_SOURCE_DIR}/cmake/AddProgram.cmake
        ${PROJECT_SOURCE_DIR}/cmake/SourceIdentity.cmake ${PROJECT_SOURCE_DIR}/cmake/FindMuJoCo.cmake
        DESTINATION ${package_folder} COMPONENT program)
