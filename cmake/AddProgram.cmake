# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
#
# Comes with find_package(mapscore) where the component program is installed.

# mapscore_add_program(NAME SOURCES...): a program with all verbs of mapscore, and the segmentation or the fusion rule
# that the sources add (docs/extending.md). Name their headers too: the keys of the trials that use them hold a hash of
# the files named here and of the target's own options and definitions.
function(mapscore_add_program name)
  if(NOT ARGN)
    message(FATAL_ERROR "mapscore_add_program(${name}): has no sources; name the file of your segmentation")
  endif()
  if(NOT TARGET mapscore::mapscore_cli)
    mapscore_find_program_libraries()
  endif()
  list(TRANSFORM ARGN REPLACE "^([^/].*)" "${CMAKE_CURRENT_SOURCE_DIR}/\\1" OUTPUT_VARIABLE files)
  set(output ${CMAKE_CURRENT_BINARY_DIR}/${name}_source)
  string(TOUPPER "${CMAKE_BUILD_TYPE}" type)
  file(GENERATE OUTPUT ${output}.txt CONTENT
"${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION} ${CMAKE_SYSTEM_PROCESSOR}
${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${type}}
$<TARGET_PROPERTY:${name},COMPILE_OPTIONS> $<TARGET_PROPERTY:${name},COMPILE_DEFINITIONS>
")
  set(identity "@identity@")  # filled in at each build
  file(CONFIGURE OUTPUT ${output}.in @ONLY CONTENT
"#include \"core/plugged.hpp\"
namespace {
[[maybe_unused]] const bool known = (mapscore::plugged_source = \"@identity@\", true);
}
")
  add_custom_command(OUTPUT ${output}.cpp
    COMMAND ${CMAKE_COMMAND} -D FOLDER=${CMAKE_CURRENT_SOURCE_DIR} "-DFILES=${files}" -D OUTPUT=${output}
            -P ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/SourceIdentity.cmake
    DEPENDS ${files} ${output}.txt ${output}.in ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/SourceIdentity.cmake
    COMMENT "Identity of the sources of ${name}" VERBATIM)
  add_executable(${name} ${ARGN} ${output}.cpp)
  target_link_libraries(${name} PRIVATE mapscore::mapscore_cli mapscore::core)
  target_compile_options(${name} PRIVATE -ffp-contract=off)  # as the core, so that results are equal everywhere
endfunction()

macro(mapscore_find_program_libraries)
  if(mapscore_simulator)
    list(APPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_FUNCTION_LIST_DIR})
    find_package(MuJoCo 3.3 REQUIRED GLOBAL)
  endif()
  find_package(OpenCV 4.5 REQUIRED COMPONENTS core imgproc imgcodecs dnn)
  foreach(library yaml-cpp CLI11 fmt SQLite3 nlohmann_json simdjson)
    find_package(${library} REQUIRED)
  endforeach()
  find_package(Boost 1.74 REQUIRED)
  include(${CMAKE_CURRENT_FUNCTION_LIST_DIR}/mapscore-program-targets.cmake)
endmacro()
