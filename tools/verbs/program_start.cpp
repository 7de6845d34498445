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
#include "reckon/tools/command_line/scene_folder.hpp"

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

/// Exit status of a child.
int wait_for(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : exit_status(ExitCode::internal);
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
  return wait_for(child);
}

/// Answers requests of the manual page and completion for a verb whose program is missing.
int answer_without_program(const VerbRow& row, Arguments arguments, const Console& console) {
  CommandLine line(row.name,
                   fmt::format("{}. A part of {}, which was missing when this page was made.",
                               row.summary, row.program),
                   fmt::format("reckon {} --help", row.name));
  return line.parse(arguments, console).value_or(exit_status(ExitCode::good));
}

/// Builds a program in the folder of a build, with the output on stderr.
void build_program(const std::filesystem::path& folder, std::string_view name) {
  const std::vector<std::string_view> rest{folder.native(), "--target", name};
  const Words words("cmake", "--build", rest);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
  pid_t child = 0;
  const int error = posix_spawnp(&child, "cmake", &actions, nullptr, words.argv(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) fail_to_start("cmake", error);
  if (wait_for(child) != 0) throw EnvironmentError("the build failed; its output is above");
}

/// Whether the user wants the program to be built. @return false without a terminal
bool wants_build(std::string_view name, const Console& console) {
  if (console.err != stderr || isatty(STDERR_FILENO) != 1 || isatty(STDIN_FILENO) != 1)
    return false;
  fmt::print(console.err, "{} is not built; build it now? about 4 minutes [y/N] ", name);
  std::fflush(console.err);
  std::array<char, 16> answer{};
  if (std::fgets(answer.data(), answer.size(), stdin) == nullptr) return false;
  return answer[0] == 'y' || answer[0] == 'Y';
}

/// The path of a program that was missing, once the user had it built.
/// @throws EnvironmentError with the remedy if it is still missing
std::filesystem::path built_program(std::string_view name, const Console& console) {
  const std::filesystem::path folder = build_folder();
  if (folder.empty())
    throw EnvironmentError(fmt::format(
        "it is a part of {0}, which is not installed: the Debian package reckon has it; without "
        "the package, run ./run build {0} and ./run install in the source tree",
        name));
  if (wants_build(name, console)) build_program(folder, name);
  const std::filesystem::path program = find_program(name);
  if (!program.empty()) return program;
  const std::filesystem::path run = (folder / "../../run").lexically_normal();
  throw EnvironmentError(fmt::format(
      "it is a part of {0}, which is not built: {1} builds it", name,
      can_run(run) ? fmt::format("{} build {}", run.string(), name)
                   : fmt::format("cmake --build {} --target {}", folder.string(), name)));
}

}  // namespace

int start_program(const VerbRow& row, Arguments arguments, const Console& console) {
  // A manual page and completion call one verb after the other.
  const bool asked = !arguments.empty() &&
                     (arguments.front() == kManualSection || arguments.front() == kListFlags);
  std::filesystem::path program = find_program(row.program);
  if (program.empty() && asked) return answer_without_program(row, arguments, console);
  if (program.empty()) program = built_program(row.program, console);
  const Words words(program, row.name, arguments);
  std::fflush(console.out);
  const bool own_streams = console.out == stdout && console.err == stderr;
  if (asked || !own_streams) return run_copied(program, words, console);
  execv(program.c_str(), words.argv());
  fail_to_start(program, errno);
}

}  // namespace reckon::tools
