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

add_executable(end_to_end_test ${sources} ${rendered})
target_link_libraries(end_to_end_test PRIVATE mapscore_lab mapscore_test_support GTest::gtest_main
                      GTest::gmock)
target_compile_definitions(end_to_end_test PRIVATE MAPSCORE_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                           MAPSCORE_PROGRAM="$<TARGET_FILE:mapscore>")
mapscore_use_precompiled(end_to_end_test mapscore_test_headers)
add_dependencies(end_to_end_test mapscore)
foreach(suite IN LISTS suites)
  add_test(NAME end_to_end.${suite}
           COMMAND end_to_end_test --gtest_filter=${suite}.*:*/${suite}.*:${suite}/*)
endforeach()

if(NOT MAPSCORE_SIMULATOR)
  return()
endif()

# A mapscore that is wrong by half a voxel (mutant/rounding_placement.cpp), whichever way a frame is placed. Its
# object comes before the library's, so the library's, which holds nothing else, is never linked.
set(placement ${PROJECT_SOURCE_DIR}/core/placement/placement.cpp)
set_source_files_properties(${placement} TARGET_DIRECTORY mapscore_core PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
set(mutant ${CMAKE_CURRENT_BINARY_DIR}/mutant)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${placement})
file(READ ${placement} text)
string(REPLACE "\nstd::vector<VoxelHit> place(" "\nstd::vector<VoxelHit> exactly_placed(" renamed "${text}")
if(renamed STREQUAL text)
  message(FATAL_ERROR "${placement}: no `std::vector<VoxelHit> place(` to put the error of half a voxel in; mend "
                      "end_to_end.cmake")
endif()
file(CONFIGURE OUTPUT ${mutant}/exact_placement.cpp CONTENT "${renamed}" @ONLY)

add_executable(mapscore_mutant ${folder}/mutant/rounding_placement.cpp $<TARGET_OBJECTS:mapscore_cli>)
target_include_directories(mapscore_mutant PRIVATE ${mutant})
target_link_libraries(mapscore_mutant PRIVATE mapscore::eval)
mapscore_build_identity(mapscore_mutant ${mapscore_deciding_rooms} tests/end_to_end/mutant)
target_compile_definitions(end_to_end_test PRIVATE MAPSCORE_MUTANT="$<TARGET_FILE:mapscore_mutant>")
add_dependencies(end_to_end_test mapscore_mutant)

# The same counts from a second implementation, written from the documents alone.
find_program(PYTHON3 python3 PATHS /usr/bin NO_DEFAULT_PATH)
find_program(PYTHON3 python3 REQUIRED)
foreach(drive apartment person)
  add_test(NAME independent_ruler.${drive}
           COMMAND ${PYTHON3} ${CMAKE_CURRENT_SOURCE_DIR}/independent/compare.py
                   $<TARGET_FILE:mapscore> ${PROJECT_SOURCE_DIR}/scenes ${drive})
  set_tests_properties(independent_ruler.${drive} PROPERTIES COST 100)  # the longest ones start first
endforeach()
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
