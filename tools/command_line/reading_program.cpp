// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/command_line/reading_program.hpp"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <string>

#include "reckon/haptics/input_files/load_progress.hpp"
#include "reckon/peer/tracks/csv_reader.hpp"
#include "reckon/tools/terminal/foreign_text.hpp"

namespace reckon::tools {

int run_reading(const Verb& verb, Arguments arguments, const Console& console) {
  const haptics::LoadProgress progress(
      [] { return std::chrono::steady_clock::now().time_since_epoch(); },
      [&](const std::filesystem::path& file, std::chrono::seconds since) {
        std::string name;
        append_clean_text(name, file.string());
        fmt::print(console.err, "reckon: reading {}, {} s\n", name, since.count());
      });
  try {
    return verb.run(arguments, console);
  } catch (const peer::CsvError& error) {
    throw UsageError(error.what());
  }
}

int run_reading_program(VerbProgram program, Arguments arguments, const Console& console) noexcept {
  program.around = run_reading;
  return run_verb_program(program, arguments, console);
}

}  // namespace reckon::tools
