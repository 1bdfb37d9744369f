# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT

# The core configures with nothing but its own dependencies at hand:
# cmake -D SOURCE= -D WORK= -P core_only_test.cmake
set(absent MuJoCo yaml-cpp CLI11 fmt SQLite3 nlohmann_json GTest benchmark)
list(TRANSFORM absent REPLACE "(.+)" "-DCMAKE_DISABLE_FIND_PACKAGE_\\1=ON")
file(REMOVE_RECURSE ${WORK})
execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK} -DMAPSCORE_CORE_ONLY=ON ${absent}
                RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "the core alone does not configure:\n${output}")
endif()
