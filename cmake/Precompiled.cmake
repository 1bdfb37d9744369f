# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
#
# Headers that nearly all sources of a kind include, compiled once. GCC alone; other compilers build without.
# Results do not depend on it: sources include what they use all the same, as builds without it show.

option(MAPSCORE_PRECOMPILE "Compile common headers once (GCC)" ON)

# mapscore_precompiled_headers(NAME OPTIONS ... LIBRARIES ... HEADERS ...): headers compiled with OPTIONS, for
# mapscore_use_precompiled(TARGET NAME). Where there is no precompiling, targets get the options alone.
function(mapscore_precompiled_headers name)
  cmake_parse_arguments(arg "" "" "OPTIONS;LIBRARIES;HEADERS" ${ARGN})
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/precompiled/${name}.cpp CONTENT "")  # stays as it is when it is there
  add_library(${name} OBJECT ${CMAKE_BINARY_DIR}/precompiled/${name}.cpp)
  target_link_libraries(${name} PRIVATE mapscore_options ${arg_LIBRARIES})
  target_compile_options(${name} PUBLIC ${arg_OPTIONS})
  if(MAPSCORE_PRECOMPILE AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    target_precompile_headers(${name} PRIVATE ${arg_HEADERS})
    mapscore_cache_precompiled(${name})
  endif()
endfunction()

function(mapscore_use_precompiled target name)
  get_target_property(options ${name} COMPILE_OPTIONS)
  if(options)
    target_compile_options(${target} PRIVATE ${options})
  endif()
  if(MAPSCORE_PRECOMPILE AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    target_precompile_headers(${target} REUSE_FROM ${name})
    mapscore_cache_precompiled(${target})
  endif()
endfunction()

# ccache takes such headers only where it is told that no macro of them changes from source to source.
function(mapscore_cache_precompiled target)
  if(CCACHE_PROGRAM)
    target_compile_options(${target} PRIVATE -fpch-preprocess)
    set_target_properties(${target} PROPERTIES CXX_COMPILER_LAUNCHER
      "${CMAKE_COMMAND};-E;env;CCACHE_SLOPPINESS=pch_defines,time_macros;${CCACHE_PROGRAM}")
  endif()
endfunction()

set(mapscore_common_headers <Eigen/Geometry> <opencv2/core.hpp> <algorithm> <array> <filesystem> <fstream> <functional>
    <map> <memory> <mutex> <optional> <set> <span> <string> <thread> <variant> <vector>)
