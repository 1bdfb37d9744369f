# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT

# Installs the core of BUILD into WORK, moves what was installed, and builds and runs the program of this
# folder against it: cmake -D BUILD= -D SOURCE= -D WORK= [-D FLAGS= -D CONFIG=] -P package_test.cmake
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\nended with ${result}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --component core --prefix ${WORK}/first)
file(RENAME ${WORK}/first ${WORK}/moved)

# Nothing in it may know where it was made or first put, nor ask for what the core does not need.
file(GLOB_RECURSE exported ${WORK}/moved/*.cmake)
list(LENGTH exported count)
if(count LESS 4)
  message(FATAL_ERROR "installed package: only ${count} CMake files")
endif()
foreach(file IN LISTS exported)
  file(READ ${file} text)
  string(TOLOWER "${text}" text)
  foreach(foreign ${BUILD} ${SOURCE} ${WORK} mujoco osmesa yaml nanoflann mapscore_options werror)
    string(TOLOWER "${foreign}" foreign)
    string(FIND "${text}" "${foreign}" at)
    if(NOT at EQUAL -1)
      message(FATAL_ERROR "${file}: names ${foreign}")
    endif()
  endforeach()
endforeach()

run(${CMAKE_COMMAND} -S ${SOURCE}/tests/package -B ${WORK}/build -DCMAKE_PREFIX_PATH=${WORK}/moved
    -DCMAKE_BUILD_TYPE=${CONFIG} "-DCMAKE_CXX_FLAGS=${FLAGS}")
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${CMAKE_COMMAND} -E chdir ${WORK}/build ${WORK}/build/map_a_crate)

# 60 x 60 pixels of the crate and none of the wall behind the 3 px rim; voxels of 5 cm at z = 2.0 to 2.05.
if(NOT output MATCHES "^crate: 3600 points, [ ]*0\\.40[0-9]* [ ]*0\\.40[0-9]* [ ]*0 m\n")
  message(FATAL_ERROR "map_a_crate: wrong segment:\n${output}")
endif()
string(REGEX MATCHALL "\n[^\n]* 2\\.025 1 0\\.5" voxels "${output}")
string(REGEX MATCHALL "\n" lines "${output}")
list(LENGTH voxels voxel_count)
list(LENGTH lines line_count)
if(NOT voxel_count EQUAL 100 OR NOT line_count EQUAL 101)
  message(FATAL_ERROR "map_a_crate: ${voxel_count} voxels of the crate in ${line_count} lines:\n${output}")
endif()
if(NOT EXISTS ${WORK}/build/crate.ot)
  message(FATAL_ERROR "map_a_crate: wrote no crate.ot")
endif()
