// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A command on another host, over ssh or what stands for it: lines to it and from it; its errors go
// where ours go.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace reckon::bench {

/// One word of a command of a POSIX shell, whatever is in it.
[[nodiscard]] std::string quoted_for_shell(std::string_view word);

/// Runs from construction to destruction at the longest. One thread.
class RemoteCommand {
 public:
  /// @param ssh words between blanks, after which the host and the command follow
  /// @throws EnvironmentError where no process can be made
  RemoteCommand(std::string_view ssh, const std::string& host, const std::string& command);
  ~RemoteCommand();
  RemoteCommand(RemoteCommand&& other) noexcept;
  RemoteCommand& operator=(RemoteCommand&&) = delete;

  /// Lost where it has ended.
  void write_line(std::string_view line);
  /// Waits for the next line, without its end; nothing where it has ended, or `go_on`, asked five
  /// times a second, says no.
  [[nodiscard]] std::optional<std::string> read_line(const std::function<bool()>& go_on);
  /// Whether nothing more will come.
  [[nodiscard]] bool has_ended() const noexcept { return ended_; }
  /// Waits for its end: its exit status; 127 where the ssh itself is not there, 128 + the signal
  /// where one killed it.
  [[nodiscard]] int status();

 private:
  int socket_ = -1;
  int child_ = -1;  // pid
  std::string read_;
  bool ended_ = false;
};

}  // namespace reckon::bench
