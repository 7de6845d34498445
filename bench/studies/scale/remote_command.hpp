// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A command on another host, over ssh or a replacement for it. Sends lines to its stdin and reads
// lines from its stdout. It shares our stderr.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace reckon::bench {

/// Quotes any text as one word for a POSIX shell.
[[nodiscard]] std::string quoted_for_shell(std::string_view word);

/// The command starts at construction and ends at destruction at the latest. One thread.
class RemoteCommand {
 public:
  /// @param ssh words separated by blanks; the host and the command are appended
  /// @throws EnvironmentError if no process can be created
  RemoteCommand(std::string_view ssh, const std::string& host, const std::string& command);
  ~RemoteCommand();
  RemoteCommand(RemoteCommand&& other) noexcept;
  RemoteCommand& operator=(RemoteCommand&&) = delete;

  /// The line is lost if the command has ended.
  void write_line(std::string_view line);
  /// Waits for the next line; its newline is removed. None if the command has ended, or if `go_on`,
  /// called five times a second, returns false.
  [[nodiscard]] std::optional<std::string> read_line(const std::function<bool()>& go_on);
  /// Whether the end of its output has been read.
  [[nodiscard]] bool has_ended() const noexcept { return ended_; }
  /// Waits for its end. @return exit status; 127 if ssh is not found, 128 + the signal that killed
  /// it, -1 if waitpid() fails
  [[nodiscard]] int status();

 private:
  int socket_ = -1;
  int child_ = -1;  // pid
  std::string read_;
  bool ended_ = false;
};

}  // namespace reckon::bench
