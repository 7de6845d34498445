# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
# Installs the output of a program as a file. The programs write the manual page and the completions themselves, at the
# installation, so that these list the verbs of the programs that are built. `page_command`, `page_words`: the command; `page_file`: the file.
cmake_policy(VERSION 3.25)
set(page "$ENV{DESTDIR}${page_file}")
cmake_path(GET page PARENT_PATH folder)
file(MAKE_DIRECTORY ${folder})
execute_process(COMMAND ${page_command} ${page_words} OUTPUT_FILE ${page} COMMAND_ERROR_IS_FATAL ANY)
file(CHMOD ${page} PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
message(STATUS "Installing: ${page}")
list(APPEND CMAKE_INSTALL_MANIFEST_FILES ${page_file})
