// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A command as typed, for reports that state how they were made.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "reckon/tools/command_line/console.hpp"

namespace reckon::tools {

/// "reckon VERB WORDS", quoted if a shell needs it.
[[nodiscard]] inline std::string command_text(std::string_view verb, Arguments arguments) {
  std::string text = fmt::format("reckon {}", verb);
  for (const std::string_view word : arguments) {
    const bool plain = word.find_first_of(" '\"*$&|<>;()") == word.npos && !word.empty();
    text += plain ? fmt::format(" {}", word) : fmt::format(" '{}'", word);
  }
  return text;
}

}  // namespace reckon::tools
