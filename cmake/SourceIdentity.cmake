# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
#
# cmake -D FOLDER= -D FILES= -D OUTPUT= -P SourceIdentity.cmake
#
# Writes OUTPUT.cpp from OUTPUT.in, with a hash of OUTPUT.txt and of FILES, by their names below FOLDER, without comments
# and white space, in the place of @identity@. Where the hash is the old one, the file stays and nothing is built again.

file(READ ${OUTPUT}.txt text)
# A string, a letter or what else there is, then the comments and the white space behind it. Strings stay as they are.
set(string "\"([^\"\\\n]|\\\\.)*\"|'([^'\\\n]|\\\\.)'")
set(blank "//[^\n]*|/\\*([^*]|\\*+[^*/])*\\*+/|[ \t\r\n]+")
foreach(file IN LISTS FILES)
  file(READ ${file} code)
  string(REGEX REPLACE "(${string}|[^\"'/ \t\r\n]+|.)(${blank})*" "\\1" code "\n${code}")
  file(RELATIVE_PATH name ${FOLDER} ${file})
  string(APPEND text "${name}${code}\n")
endforeach()
string(SHA256 identity "${text}")
string(SUBSTRING "${identity}" 0 16 identity)
configure_file(${OUTPUT}.in ${OUTPUT}.cpp @ONLY)
