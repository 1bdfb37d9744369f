# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT

# Tests of the built program, from the outside. A suite is one entry of CTest, since its tests share what it
# records. The suites are read from the sources, so that none is forgotten.
set(folder ${CMAKE_CURRENT_SOURCE_DIR}/end_to_end)
file(GLOB sources CONFIGURE_DEPENDS ${folder}/*.cpp)
if(MAPSCORE_SIMULATOR)
  file(GLOB rendered CONFIGURE_DEPENDS ${folder}/rendered/*.cpp)
endif()
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${sources} ${rendered})
set(suites)
foreach(source IN LISTS sources rendered)
  file(STRINGS ${source} tests REGEX "^TEST(_F|_P)?\\(")
  list(TRANSFORM tests REPLACE "^TEST[_FP]*\\(([A-Za-z]+),.*" "\\1")
  list(APPEND suites ${tests})
endforeach()
list(REMOVE_DUPLICATES suites)

# A rival as a command of a study.
add_executable(octomap_mapper ${PROJECT_SOURCE_DIR}/configs/external/octomap_mapper.cpp)
target_link_libraries(octomap_mapper PRIVATE mapscore_foreign)

find_program(PYTHON3 python3 PATHS /usr/bin NO_DEFAULT_PATH)
find_program(PYTHON3 python3 REQUIRED)
add_executable(end_to_end_test ${sources} ${rendered})
target_link_libraries(end_to_end_test PRIVATE mapscore_lab mapscore_test_support GTest::gtest_main
                      GTest::gmock)
target_compile_definitions(end_to_end_test PRIVATE MAPSCORE_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                           MAPSCORE_PROGRAM="$<TARGET_FILE:mapscore>"
                           MAPSCORE_PYTHON="${PYTHON3}" OCTOMAP_MAPPER="$<TARGET_FILE:octomap_mapper>")
mapscore_use_precompiled(end_to_end_test mapscore_test_headers)
add_dependencies(end_to_end_test mapscore octomap_mapper)
foreach(suite IN LISTS suites)
  add_test(NAME end_to_end.${suite}
           COMMAND end_to_end_test --gtest_filter=${suite}.*:*/${suite}.*:${suite}/*)
endforeach()

if(NOT MAPSCORE_SIMULATOR)
  return()
endif()

# mapscore_mutant(NAME MUTANT SOURCE RETURNS FUNCTION EXACT): a mapscore with mutant/MUTANT.cpp in the place of
# core/SOURCE.cpp, whose own FUNCTION CMake writes, as EXACT, into a file beside it. The mutant's object comes before
# the library's, so the library's, which holds nothing else, is never linked.
function(mapscore_mutant name mutant source returns function exact)
  set(original ${PROJECT_SOURCE_DIR}/core/${source}.cpp)
  set_source_files_properties(${original} TARGET_DIRECTORY mapscore_core PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${original})
  file(READ ${original} text)
  string(REPLACE "\n${returns} ${function}(" "\n${returns} ${exact}(" renamed "${text}")
  if(renamed STREQUAL text)
    message(FATAL_ERROR "${original}: no `${returns} ${function}(` to put an error in; mend end_to_end.cmake")
  endif()
  set(written ${CMAKE_CURRENT_BINARY_DIR}/mutant)
  file(CONFIGURE OUTPUT ${written}/${exact}.cpp CONTENT "${renamed}" @ONLY)
  add_executable(${name} ${folder}/mutant/${mutant}.cpp $<TARGET_OBJECTS:mapscore_cli>)
  target_include_directories(${name} PRIVATE ${written})
  target_link_libraries(${name} PRIVATE mapscore::eval)
  mapscore_build_identity(${name} ${mapscore_deciding_rooms} tests/end_to_end/mutant)
endfunction()

mapscore_mutant(mapscore_mutant rounding_placement placement/placement "std::vector<VoxelHit>" place exactly_placed)
target_compile_definitions(end_to_end_test PRIVATE MAPSCORE_MUTANT="$<TARGET_FILE:mapscore_mutant>")
add_dependencies(end_to_end_test mapscore_mutant)
# Of tests/gate/trials.py, which CI does not run.
mapscore_mutant(mapscore_losing_voxels losing_voxels placement/placement "std::vector<VoxelHit>" place exactly_placed)
mapscore_mutant(mapscore_eroding_more eroding_more segmentation/erosion cv::Mat1b erode_mask exactly_eroded)
set_target_properties(mapscore_losing_voxels mapscore_eroding_more PROPERTIES EXCLUDE_FROM_ALL ON)

# The same counts from a second implementation, written from the documents alone.
foreach(drive apartment person)
  add_test(NAME independent_ruler.${drive}
           COMMAND ${PYTHON3} ${CMAKE_CURRENT_SOURCE_DIR}/independent/compare.py
                   $<TARGET_FILE:mapscore> ${PROJECT_SOURCE_DIR}/scenes ${drive})
  set_tests_properties(independent_ruler.${drive} PROPERTIES COST 100)  # the longest ones start first
endforeach()
# What CI reads of `check`, and what docs/ci.md tells people to copy.
add_test(NAME gate.formats COMMAND ${PYTHON3} -B ${CMAKE_CURRENT_SOURCE_DIR}/gate/formats.py $<TARGET_FILE:mapscore>)
add_test(NAME gate.page
         COMMAND ${PYTHON3} -B ${CMAKE_CURRENT_SOURCE_DIR}/gate/page.py $<TARGET_FILE:mapscore>
                 $<TARGET_FILE:mapscore_mutant> ${CMAKE_CURRENT_BINARY_DIR}/gate_page)
add_test(NAME independent_ruler.foreign_maps
         COMMAND ${PYTHON3} ${CMAKE_CURRENT_SOURCE_DIR}/independent/foreign_maps.py
                 $<TARGET_FILE:mapscore> ${PROJECT_SOURCE_DIR}/scenes)
foreach(what draws rules verdicts)
  add_test(NAME independent_ruler.fused_${what}
           COMMAND ${PYTHON3} ${CMAKE_CURRENT_SOURCE_DIR}/independent/fused_maps.py
                   $<TARGET_FILE:mapscore> ${PROJECT_SOURCE_DIR}/scenes ${what})
endforeach()
foreach(what depth labels)
  add_test(NAME independent_ruler.faulty_${what}
           COMMAND ${PYTHON3} ${CMAKE_CURRENT_SOURCE_DIR}/independent/faulty_images.py
                   $<TARGET_FILE:mapscore> ${PROJECT_SOURCE_DIR}/scenes ${what})
endforeach()
add_test(NAME independent_ruler.edge_aligned
         COMMAND ${PYTHON3} ${CMAKE_CURRENT_SOURCE_DIR}/independent/edge_aligned.py $<TARGET_FILE:mapscore>)
add_test(NAME independent_ruler.selfcheck COMMAND ${PYTHON3} ${CMAKE_CURRENT_SOURCE_DIR}/independent/selfcheck.py)
add_test(NAME independent_ruler.statistics
         COMMAND ${PYTHON3} ${CMAKE_CURRENT_SOURCE_DIR}/independent/statistics_check.py $<TARGET_FILE:mapscore>)
set_tests_properties(independent_ruler.foreign_maps independent_ruler.statistics PROPERTIES COST 100)
