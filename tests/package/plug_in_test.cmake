# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT

# Installs core and program of BUILD into WORK, moves what was installed, builds the program of plug_in/ against it and
# sweeps a tiny recording with its segmentation and its fusion rule beside those of mapscore:
# cmake -D BUILD= -D SOURCE= -D WORK= -D PYTHON3= [-D MUJOCO= -D FLAGS= -D CONFIG=] -P plug_in_test.cmake
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  set(output "${output}" PARENT_SCOPE)
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\nended with ${result}:\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
foreach(component core program)
  run(${CMAKE_COMMAND} --install ${BUILD} --component ${component} --prefix ${WORK}/first)
endforeach()
file(RENAME ${WORK}/first ${WORK}/moved)
file(GLOB_RECURSE exported ${WORK}/moved/*.cmake)
foreach(file IN LISTS exported)
  file(READ ${file} text)
  foreach(foreign ${BUILD} ${SOURCE} ${WORK} mapscore_options)
    string(FIND "${text}" "${foreign}" at)
    if(NOT at EQUAL -1)
      message(FATAL_ERROR "${file}: names ${foreign}")
    endif()
  endforeach()
endforeach()

file(COPY ${SOURCE}/tests/package/plug_in DESTINATION ${WORK})
run(${CMAKE_COMMAND} -S ${WORK}/plug_in -B ${WORK}/build -DCMAKE_PREFIX_PATH=${WORK}/moved -DMuJoCo_ROOT=${MUJOCO}
    -DCMAKE_BUILD_TYPE=${CONFIG} "-DCMAKE_CXX_FLAGS=${FLAGS}")
run(${CMAKE_COMMAND} --build ${WORK}/build)
set(mine ${WORK}/build/mine)

run(${mine} --version)
if(NOT output MATCHES "^mapscore .*, with depth_band, with weighted_vote\n$")
  message(FATAL_ERROR "--version: ${output}")
endif()
run(${mine} map --help)
if(NOT output MATCHES "Of depth_band: largest distance from the median depth \\[0.3\\]")
  message(FATAL_ERROR "map --help does not offer the parameter:\n${output}")
endif()

file(WRITE ${WORK}/tiny.py "import sys
sys.path.insert(0, '${SOURCE}/tests/hostile')
import tiny_files
tiny_files.write_recording('${WORK}/tiny')
")
run(${PYTHON3} -B ${WORK}/tiny.py)
file(WRITE ${WORK}/study.yaml "recording: tiny
methods:
  direct: {segmentation: direct, fusion: vote}
  unbounded: {segmentation: {depth_band: {band_m: 1000}}, fusion: {weighted_vote: {weight: 1}}}
  mine: {segmentation: {depth_band: {band_m: 0.05}}}
sweep: {methods.mine.segmentation.depth_band.band_m: [0.01, 0.3]}
seeds: 2
")
run(${mine} sweep ${WORK}/study.yaml -o ${WORK}/swept -q)
run(${mine} table ${WORK}/swept --tidy)
string(REPLACE "\n" ";" rows "${output}")

# A band that holds every point and a vote of weight 1 are mapscore's own methods: equal in each count and figure.
foreach(method direct unbounded)
  set(rows_of_${method} ${rows})
  list(FILTER rows_of_${method} INCLUDE REGEX "^trial,${method},")
  list(FILTER rows_of_${method} EXCLUDE REGEX "_s,")
  list(TRANSFORM rows_of_${method} REPLACE ",${method}," ",METHOD,")
  list(LENGTH rows_of_${method} count)
  if(count LESS 100)
    message(FATAL_ERROR "${count} rows of ${method} in ${WORK}/swept")
  endif()
endforeach()
if(NOT rows_of_direct STREQUAL rows_of_unbounded)
  message(FATAL_ERROR "depth_band without a bound is not direct; see the rows of `table --tidy` in ${WORK}/swept")
endif()

# Other sources are other trials of the kinds they add; the trials of direct and of the ceiling stay.
file(READ ${WORK}/plug_in/my_segmentation.cpp code)
string(REPLACE "<= band_m" "< band_m" code "${code}")
file(WRITE ${WORK}/plug_in/my_segmentation.cpp "${code}")
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${mine} sweep ${WORK}/study.yaml -o ${WORK}/swept)
if(NOT output MATCHES "6 trials computed, 4 already there")
  message(FATAL_ERROR "after a change of the source:\n${output}")
endif()

# So are other options and definitions of the target.
run(${CMAKE_COMMAND} ${WORK}/build -DWEIGHT=2)
file(READ ${WORK}/build/mine_source.txt decides)
if(NOT decides MATCHES "WEIGHT=2")
  message(FATAL_ERROR "the identity of the sources does not cover the target's definitions:\n${decides}")
endif()
