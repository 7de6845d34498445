# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
# The programs write the manual page and the completions themselves, so that these are never behind them.
set(programs reckon reckon-peer reckon-inspect)
if(TARGET reckon-bench)
  list(APPEND programs reckon-bench)
endif()
set(pages reckon.1 reckon.bash reckon.zsh reckon.fish)
list(TRANSFORM pages PREPEND ${PROJECT_BINARY_DIR}/)
add_custom_command(OUTPUT ${pages} DEPENDS ${programs} WORKING_DIRECTORY ${PROJECT_BINARY_DIR} VERBATIM
  COMMAND $<TARGET_FILE:reckon> help --man > reckon.1
  COMMAND $<TARGET_FILE:reckon> completion bash > reckon.bash
  COMMAND $<TARGET_FILE:reckon> completion zsh > reckon.zsh
  COMMAND $<TARGET_FILE:reckon> completion fish > reckon.fish)
add_custom_target(reckon_pages ALL DEPENDS ${pages})
