# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
#
# Finds the headers of small_gicp: first those that scripts/setup.sh unpacks under build/deps, then the system's.
# Defines the target small_gicp::headers. They are taken as system headers: their warnings are not ours.

file(GLOB _small_gicp_local "${PROJECT_SOURCE_DIR}/build/deps/small_gicp-*/include")
find_path(small_gicp_INCLUDE_DIR small_gicp/registration/registration.hpp HINTS ${_small_gicp_local})

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(small_gicp REQUIRED_VARS small_gicp_INCLUDE_DIR
                                  REASON_FAILURE_MESSAGE "run scripts/setup.sh, which fetches it")

if(small_gicp_FOUND AND NOT TARGET small_gicp::headers)
  add_library(small_gicp::headers INTERFACE IMPORTED)
  set_target_properties(small_gicp::headers PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${small_gicp_INCLUDE_DIR}")
endif()
