// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The manual page `man reckon`, made from the table of verbs and from what each verb declares to
// its command line, so that page, `--help` and completion cannot tell different things.
#pragma once

#include <cstdio>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/tools/command_line/console.hpp"

namespace reckon::tools {

/// One flag or word that a verb takes.
struct ManualEntry {
  std::string names;  ///< "-h,--help", or the name of a word
  std::string value;  ///< what follows the flag, or "a|b" where that or the word is one of few
  std::string help;
};

/// All that a verb tells about itself.
struct ManualSection {
  std::string verb;
  std::string summary;   ///< lines that begin with a space stay lines
  std::string synopsis;  ///< "[SOURCE] [VIEW] [FLAGS]"
  std::vector<ManualEntry> entries;
  std::vector<std::string> examples;  ///< one command each
};

/// The text with every character that roff takes for a command made harmless.
[[nodiscard]] std::string roff_text(std::string_view text);

/// Writes one subsection of the page.
void print_manual_section(const ManualSection& section, std::FILE* out);

/// Writes the whole page in the macros of man(7). Asks each verb for its section.
void print_manual_page(std::span<const Verb> verbs, std::FILE* out);

}  // namespace reckon::tools
