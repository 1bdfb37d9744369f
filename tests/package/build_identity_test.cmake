# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
#
# cmake -D SOURCE=... -D WORK=... -P build_identity_test.cmake
#
# The identity changes with code, strings, names of files and settings, and with neither comments nor white space.

set(code [[
// Erodes.
int eroded(int radius_px) {  /* in pixels */
  const char* url = "http://a b";  // "not a string
  return radius_px + '"' / 2;
}
]])

function(identity_of result code)
  set(name a.cpp)
  set(settings "GNU 12 -O3")
  cmake_parse_arguments(PARSE_ARGV 2 "" "" "name;settings" "")
  foreach(setting name settings)
    if(DEFINED _${setting})
      set(${setting} "${_${setting}}")
    endif()
  endforeach()
  file(REMOVE_RECURSE ${WORK})
  file(WRITE ${WORK}/core/${name} "${code}")
  file(WRITE ${WORK}/identity.txt "${settings}")
  file(WRITE ${WORK}/identity.in "return \"@identity@\";\n")
  execute_process(COMMAND ${CMAKE_COMMAND} -D FOLDER=${WORK} -D FILES=${WORK}/core/${name} -D OUTPUT=${WORK}/identity
                          -P ${SOURCE}/cmake/SourceIdentity.cmake COMMAND_ERROR_IS_FATAL ANY)
  file(STRINGS ${WORK}/identity.cpp line REGEX "return \"[0-9a-f]+\";")
  if(NOT line)
    message(FATAL_ERROR "no identity of: ${code}")
  endif()
  set(${result} "${line}" PARENT_SCOPE)
endfunction()

identity_of(expected "${code}")

function(expect_same what from to)
  string(REPLACE "${from}" "${to}" changed "${code}")
  identity_of(identity "${changed}")
  if(changed STREQUAL code OR NOT identity STREQUAL expected)
    message(SEND_ERROR "${what} changed the identity: '${from}' to '${to}'")
  endif()
endfunction()
expect_same("a comment" "Erodes" "Erodes; by \"radius_px\" and [more]")
expect_same("no comment" "// Erodes.\n" "")
expect_same("a comment behind code" "not a string" "other")
expect_same("a comment of C" "in pixels" "in * pixels,\n two lines")
expect_same("white space" "radius_px) {" "radius_px)\n\n{\t")

function(expect_other what from to)
  string(REPLACE "${from}" "${to}" changed "${code}")
  identity_of(identity "${changed}" ${ARGN})
  if(identity STREQUAL expected)
    message(SEND_ERROR "${what} left the identity as it was: '${from}' to '${to}'")
  endif()
endfunction()
expect_other("one pixel more" "return radius_px" "return 1 + radius_px")
expect_other("a string with slashes" "//a b" "//a c")
expect_other("white space of a string" "//a b" "//ab")
expect_other("a letter" "'\"'" "'\\''")
expect_other("code behind a letter" "/ 2" "/ 3")
expect_other("another name" "" "" name b.cpp)
expect_other("other settings" "" "" settings "GNU 12 -O2")
