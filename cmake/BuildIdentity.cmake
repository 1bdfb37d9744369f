# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
#
# build_identity() of eval/results/build_identity.hpp: a hash of the sources that decide results, by path, without
# comments and white space, and of what compiles them (SourceIdentity.cmake).

# All rooms whose code decides a trial's counts, or the recording they come from.
set(mapscore_deciding_rooms core files sim eval/recording eval/foreign eval/networks eval/map_files eval/truth
    eval/localization eval/score eval/objects eval/study eval/results eval/lab eval/render eval/explore)

# mapscore_build_identity(TARGET ROOMS...): adds a source with the identity of the sources below ROOMS to TARGET.
function(mapscore_build_identity target)
  set(sources)
  foreach(room IN LISTS ARGN)
    file(GLOB_RECURSE of_room CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${room}/*.cpp ${PROJECT_SOURCE_DIR}/${room}/*.hpp)
    list(APPEND sources ${of_room})
  endforeach()
  string(TOUPPER "${CMAKE_BUILD_TYPE}" type)
  get_target_property(options mapscore_options INTERFACE_COMPILE_OPTIONS)
  list(FILTER options INCLUDE REGEX "^-[fmO]")  # warnings decide nothing
  set(mujoco none)
  if(MAPSCORE_SIMULATOR)
    get_filename_component(mujoco "${MuJoCo_LIBRARY}" REALPATH)  # its name tells the whole version
    get_filename_component(mujoco "${mujoco}" NAME)
  endif()
  set(output ${CMAKE_CURRENT_BINARY_DIR}/${target}_identity)
  file(CONFIGURE OUTPUT ${output}.txt @ONLY CONTENT
"@CMAKE_CXX_COMPILER_ID@ @CMAKE_CXX_COMPILER_VERSION@ @CMAKE_SYSTEM_PROCESSOR@
@CMAKE_CXX_FLAGS@ ${CMAKE_CXX_FLAGS_${type}} @options@
Eigen @Eigen3_VERSION@ OpenCV @OpenCV_VERSION@ octomap @octomap_VERSION@ MuJoCo @mujoco@
")
  set(identity "@identity@")  # filled in at each build
  file(CONFIGURE OUTPUT ${output}.in @ONLY CONTENT
"#include \"eval/results/build_identity.hpp\"

std::string_view mapscore::eval::build_identity() {
  return \"@identity@\";
}
")
  add_custom_command(OUTPUT ${output}.cpp
    COMMAND ${CMAKE_COMMAND} -D FOLDER=${PROJECT_SOURCE_DIR} "-DFILES=${sources}" -D OUTPUT=${output}
            -P ${PROJECT_SOURCE_DIR}/cmake/SourceIdentity.cmake
    DEPENDS ${sources} ${output}.txt ${output}.in ${PROJECT_SOURCE_DIR}/cmake/SourceIdentity.cmake
    COMMENT "Identity of what decides results" VERBATIM)
  target_sources(${target} PRIVATE ${output}.cpp)
  set_source_files_properties(${output}.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON SKIP_PRECOMPILE_HEADERS ON)
endfunction()
