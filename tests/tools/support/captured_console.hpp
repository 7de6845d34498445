// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Runs the program in process and stores its output.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/command_line/reading_program.hpp"
#include "reckon/tools/inspect_program.hpp"
#include "reckon/tools/peer_program.hpp"
#include "reckon/tools/program.hpp"

namespace reckon::test {

/// A stream into a string.
class CapturedStream {
 public:
  CapturedStream() : file_(open_memstream(&text_, &size_)) {}
  ~CapturedStream() {
    std::fclose(file_);
    std::free(text_);
  }
  CapturedStream(const CapturedStream&) = delete;
  CapturedStream& operator=(const CapturedStream&) = delete;

  [[nodiscard]] std::FILE* file() const { return file_; }
  [[nodiscard]] std::string text() const {
    std::fflush(file_);
    return {text_, size_};
  }

 private:
  char* text_ = nullptr;
  std::size_t size_ = 0;
  std::FILE* file_;
};

/// The result of one call of the program.
struct ProgramResult {
  int status;
  std::string out;
  std::string err;

  /// Lines of out without their ends.
  [[nodiscard]] std::vector<std::string> lines() const {
    std::vector<std::string> lines;
    std::istringstream stream(out);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
  }
};

using Program = int (*)(tools::Arguments arguments, const tools::Console& console) noexcept;

/// Runs a program; `stop` is the flag that Ctrl-C sets.
inline ProgramResult run_captured(Program program, const std::vector<std::string>& arguments,
                                  const std::atomic<bool>* stop = nullptr) {
  const CapturedStream out;
  const CapturedStream err;
  tools::Console console;
  console.out = out.file();
  console.err = err.file();
  console.stop = stop;
  const std::vector<std::string_view> words(arguments.begin(), arguments.end());
  const int status = program(words, console);
  return {status, out.text(), err.text()};
}

/// Runs the verb in this process, unless it belongs to reckon-bench.
inline int start_in_process(const tools::VerbRow& row, tools::Arguments arguments,
                            const tools::Console& console) {
  if (row.program == tools::kBenchProgram) return tools::start_program(row, arguments, console);
  const auto own =
      row.program == tools::kPeerProgram ? tools::peer_verbs() : tools::inspect_verbs();
  return tools::run_reading(*std::ranges::find(own, row.name, &tools::Verb::name), arguments,
                            console);
}

/// `reckon ARGUMENTS`, in this process.
inline int run_program(tools::Arguments arguments, const tools::Console& console) noexcept {
  return tools::run_program(arguments, console, start_in_process);
}

/// Runs `reckon ARGUMENTS`.
inline ProgramResult run_reckon(const std::vector<std::string>& arguments,
                                const std::atomic<bool>* stop = nullptr) {
  return run_captured(run_program, arguments, stop);
}

/// Flags of a verb, from completion.
inline std::vector<std::string> flags_of(std::vector<std::string> verb,
                                         Program program = run_program) {
  verb.emplace_back(tools::kListFlags);
  std::vector<std::string> flags;
  for (const std::string& line : run_captured(program, verb).lines())
    flags.push_back(line.substr(0, line.find(' ')));
  return flags;
}

}  // namespace reckon::test
