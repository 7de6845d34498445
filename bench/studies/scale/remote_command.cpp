// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/remote_command.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <utility>
#include <vector>

#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {
namespace {

constexpr int kAsked = 200;  // [ms], period of go_on
constexpr int kNotFound = 127, kSignalled = 128;

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    if (!word.empty()) words.emplace_back(word);
    text.remove_prefix(std::min(word.size() + 1, text.size()));
  }
  return words;
}

}  // namespace

std::string quoted_for_shell(std::string_view word) {
  std::string quoted = "'";
  for (const char letter : word) {
    if (letter == '\'') quoted += "'\\'";
    quoted += letter;
  }
  return quoted + "'";
}

RemoteCommand::RemoteCommand(std::string_view ssh, const std::string& host,
                             const std::string& command) {
  std::vector<std::string> words = words_of(ssh);
  words.push_back(host);
  words.push_back(command);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw tools::EnvironmentError(
        fmt::format("no socket to {}: {}", words.front(), std::strerror(errno)));
  std::fflush(nullptr);
  child_ = fork();
  if (child_ == 0) {
    if (dup2(ends[1], STDIN_FILENO) >= 0 && dup2(ends[1], STDOUT_FILENO) >= 0)
      execvp(arguments[0], arguments.data());
    fmt::print(stderr, "{}: {}\n", words.front(), std::strerror(errno));
    std::fflush(stderr);
    _exit(kNotFound);
  }
  const int error = errno;
  close(ends[1]);
  socket_ = ends[0];
  if (child_ > 0) return;
  close(socket_);
  throw tools::EnvironmentError(
      fmt::format("no process for {}: {}", words.front(), std::strerror(error)));
}

RemoteCommand::RemoteCommand(RemoteCommand&& other) noexcept
    : socket_(std::exchange(other.socket_, -1)),
      child_(std::exchange(other.child_, -1)),
      read_(std::move(other.read_)),
      ended_(other.ended_) {}

RemoteCommand::~RemoteCommand() {
  if (socket_ >= 0) close(socket_);
  if (child_ <= 0) return;
  kill(child_, SIGTERM);
  waitpid(child_, nullptr, 0);
}

void RemoteCommand::write_line(std::string_view line) {
  const std::string text = std::string(line) + '\n';
  static_cast<void>(send(socket_, text.data(), text.size(), MSG_NOSIGNAL));
}

std::optional<std::string> RemoteCommand::read_line(const std::function<bool()>& go_on) {
  for (std::size_t searched = 0;;) {
    const auto end = read_.find('\n', searched);
    if (end != read_.npos) {
      std::string line = read_.substr(0, end);
      read_.erase(0, end + 1);
      return line;
    }
    searched = read_.size();
    if (ended_ || !go_on()) return std::nullopt;
    pollfd in{socket_, POLLIN, 0};
    if (poll(&in, 1, kAsked) <= 0) continue;
    std::array<char, 65536> octets;
    const ssize_t got = recv(socket_, octets.data(), octets.size(), 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0)
      ended_ = true;
    else
      read_.append(octets.data(), static_cast<std::size_t>(got));
  }
}

int RemoteCommand::status() {
  int status = 0;
  pid_t ended = -1;
  do ended = waitpid(child_, &status, 0);
  while (ended < 0 && errno == EINTR);
  if (ended != std::exchange(child_, -1)) return -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : kSignalled + WTERMSIG(status);
}

}  // namespace reckon::bench
