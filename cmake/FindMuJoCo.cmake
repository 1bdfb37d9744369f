# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
#
# Finds MuJoCo (3.3 or newer): first the release that scripts/setup.sh unpacks under build/deps, then the
# system's. Defines the target MuJoCo::MuJoCo.

file(GLOB _mujoco_local "${PROJECT_SOURCE_DIR}/build/deps/mujoco-*/mujoco")
find_path(MuJoCo_INCLUDE_DIR mujoco/mujoco.h HINTS ${_mujoco_local} PATH_SUFFIXES include)
file(GLOB _mujoco_libraries "${MuJoCo_INCLUDE_DIR}/../libmujoco.so*")
if(_mujoco_libraries)
  list(GET _mujoco_libraries 0 MuJoCo_LIBRARY)
else()
  find_library(MuJoCo_LIBRARY mujoco)
endif()

if(MuJoCo_INCLUDE_DIR)
  file(STRINGS "${MuJoCo_INCLUDE_DIR}/mujoco/mujoco.h" _mujoco_header REGEX "define mjVERSION_HEADER")
  string(REGEX MATCH "[0-9]+" _mujoco_number "${_mujoco_header}")
  if(_mujoco_number LESS 1000000)  # 337 until 3.3, 4000001 from 4.0 on
    math(EXPR _major "${_mujoco_number} / 100")
    math(EXPR _minor "${_mujoco_number} / 10 % 10")
  else()
    math(EXPR _major "${_mujoco_number} / 1000000")
    math(EXPR _minor "${_mujoco_number} / 1000 % 1000")
  endif()
  set(MuJoCo_VERSION "${_major}.${_minor}")
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(MuJoCo REQUIRED_VARS MuJoCo_LIBRARY MuJoCo_INCLUDE_DIR
                                  VERSION_VAR MuJoCo_VERSION
                                  REASON_FAILURE_MESSAGE "run scripts/setup.sh, which fetches it, or configure with -DMAPSCORE_SIMULATOR=OFF")

if(MuJoCo_FOUND AND NOT TARGET MuJoCo::MuJoCo)
  add_library(MuJoCo::MuJoCo SHARED IMPORTED)
  set_target_properties(MuJoCo::MuJoCo PROPERTIES IMPORTED_LOCATION "${MuJoCo_LIBRARY}"
                        INTERFACE_INCLUDE_DIRECTORIES "${MuJoCo_INCLUDE_DIR}")
endif()
