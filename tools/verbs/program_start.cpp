// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/verbs/program_start.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "reckon/tools/command_line/command_line.hpp"

namespace reckon::tools {
namespace {

bool can_run(const std::filesystem::path& path) { return access(path.c_str(), X_OK) == 0; }

/// Path of a program: in this program's folder, else in ../libexec/reckon, else in a folder of
/// PATH. Empty if it is in none.
std::filesystem::path find_program(std::string_view name) {
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  if (!error) {
    for (const char* folder : {".", "../libexec/reckon"}) {
      const auto there = (self.parent_path() / folder / name).lexically_normal();
      if (can_run(there)) return there;
    }
  }
  const char* path = std::getenv("PATH");
  std::string_view folders = path != nullptr ? path : "";
  while (!folders.empty()) {
    const std::size_t end = std::min(folders.find(':'), folders.size());
    const auto there = std::filesystem::path(folders.substr(0, end)) / name;
    if (end > 0 && can_run(there)) return there;
    folders.remove_prefix(std::min(end + 1, folders.size()));
  }
  return {};
}

/// Argument vector of `PROGRAM VERB ARGUMENTS`.
class Words {
 public:
  Words(const std::filesystem::path& program, std::string_view verb, Arguments arguments)
      : texts_{program.string(), std::string(verb)} {
    for (const std::string_view word : arguments) texts_.emplace_back(word);
    for (std::string& text : texts_) pointers_.push_back(text.data());
    pointers_.push_back(nullptr);
  }
  [[nodiscard]] char* const* argv() const { return pointers_.data(); }

 private:
  std::vector<std::string> texts_;
  std::vector<char*> pointers_;
};

[[noreturn]] void fail_to_start(const std::filesystem::path& program, int error) {
  throw EnvironmentError(fmt::format("{} does not start: {}", program.string(),
                                     std::generic_category().message(error)));
}

/// Runs the program with its output copied to `console.out`. @return its exit status
int run_copied(const std::filesystem::path& program, const Words& words, const Console& console) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
    throw std::system_error(errno, std::generic_category(), "a pipe to a program of reckon");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  pid_t child = 0;
  const int error = posix_spawn(&child, program.c_str(), &actions, nullptr, words.argv(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  std::array<char, 4096> buffer{};
  ssize_t got = 0;
  while (error == 0 &&
         ((got = read(ends[0], buffer.data(), buffer.size())) > 0 || (got < 0 && errno == EINTR))) {
    if (got > 0) std::fwrite(buffer.data(), 1, static_cast<std::size_t>(got), console.out);
  }
  close(ends[0]);
  if (error != 0) fail_to_start(program, error);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : exit_status(ExitCode::internal);
}

/// Answers requests of the manual page and completion for a verb whose program is missing; other
/// calls are an error.
int answer_without_program(const VerbRow& row, Arguments arguments, const Console& console) {
  const std::string_view first = arguments.empty() ? std::string_view{} : arguments.front();
  if (first == kManualSection || first == kListFlags) {
    CommandLine line(row.name,
                     fmt::format("{}. A part of {}, which was missing when this page was made.",
                                 row.summary, row.program),
                     fmt::format("reckon {} --help", row.name));
    return line.parse(arguments, console).value_or(exit_status(ExitCode::good));
  }
  throw EnvironmentError(
      fmt::format("it is a part of {0}, which is neither beside reckon nor in PATH: build it with "
                  "./run build {0}, or install both",
                  row.program));
}

}  // namespace

int start_program(const VerbRow& row, Arguments arguments, const Console& console) {
  const std::filesystem::path program = find_program(row.program);
  if (program.empty()) return answer_without_program(row, arguments, console);
  const Words words(program, row.name, arguments);
  std::fflush(console.out);
  // A manual page and completion call one verb after the other.
  const bool asked = !arguments.empty() &&
                     (arguments.front() == kManualSection || arguments.front() == kListFlags);
  const bool own_streams = console.out == stdout && console.err == stderr;
  if (asked || !own_streams) return run_copied(program, words, console);
  execv(program.c_str(), words.argv());
  fail_to_start(program, errno);
}

}  // namespace reckon::tools
