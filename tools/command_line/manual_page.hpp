// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The manual page `man reckon`, made from the table of verbs and each verb's command line
// declarations, so that page, `--help` and completion always agree.
#pragma once

#include <cstdio>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/tools/command_line/console.hpp"

namespace reckon::tools {

/// One flag or word of a verb.
struct ManualEntry {
  std::string names;  ///< "-h,--help", or the name of a word
  std::string value;  ///< value of the flag, or "a|b" if the value or the word is one of few
  std::string help;
};

/// Description of a verb.
struct ManualSection {
  std::string verb;
  std::string summary;   ///< lines that begin with a space are not filled
  std::string synopsis;  ///< "[SOURCE] [VIEW] [FLAGS]"
  std::vector<ManualEntry> entries;
  std::vector<std::string> examples;  ///< one command each
};

/// Escapes all characters that are special in roff.
[[nodiscard]] std::string roff_text(std::string_view text);

/// Writes one subsection of the page.
void print_manual_section(const ManualSection& section, std::FILE* out);

/// Writes the whole page in the macros of man(7). Requests the section of each verb.
void print_manual_page(std::span<const Verb> verbs, std::FILE* out);

}  // namespace reckon::tools
