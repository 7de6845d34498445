# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
# Installs headers and all that they include. `from`: the folder that include lines start from; `headers`: paths in it;
# `to`: the folder of the destination, as in install(). Includes are read when it is installed, so that the list is never stale.
cmake_policy(VERSION 3.25)
set(pending ${headers})
set(found)
while(pending)
  list(POP_FRONT pending header)
  if(header IN_LIST found)
    continue()
  endif()
  list(APPEND found ${header})
  file(STRINGS ${from}/${header} lines REGEX "^ *# *include \"reckon/")
  foreach(line IN LISTS lines)
    string(REGEX REPLACE "^[^\"]*\"([^\"]*)\".*$" "\\1" included "${line}")
    list(APPEND pending ${included})
  endforeach()
endwhile()
foreach(header IN LISTS found)
  cmake_path(GET header PARENT_PATH folder)
  # The folders are links; only what they hold is installed.
  file(REAL_PATH ${from}/${header} source)
  file(INSTALL DESTINATION ${to}/${folder} TYPE FILE FILES ${source})
endforeach()
