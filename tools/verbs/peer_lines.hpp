// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The JSON lines that `reckon peer` prints while it runs.
#pragma once

#include <chrono>
#include <cstdio>
#include <string>
#include <string_view>

#include "reckon/peer/loops/notice.hpp"
#include "reckon/peer/network/datagram_balance.hpp"
#include "reckon/tools/verbs/running_peer.hpp"

namespace reckon::tools {

/// Flushes at once, for readers of a pipe.
void print_line(std::FILE* out, const std::string& text);
void print_notice(std::FILE* out, peer::NoticeKind kind, peer::Severity severity,
                  std::string_view text, double seconds);

/// Prints the fate of each datagram, every `every`.
class BalanceLines {
 public:
  BalanceLines(std::chrono::nanoseconds every, std::FILE* out)
      : every_(every), next_(every), out_(out) {}

  [[nodiscard]] peer::DatagramTap& tap() { return tap_; }
  void look(const RunningPeer& running) {
    balance_.look();
    if (running.elapsed() < next_) return;
    next_ += every_;
    tell(running, false);
  }
  /// Prints the last line; call it after the peer has stopped.
  void end(const RunningPeer& running) {
    balance_.look();
    tell(running, true);
  }

 private:
  void tell(const RunningPeer& running, bool end);

  std::chrono::nanoseconds every_, next_;
  std::FILE* out_;
  peer::DatagramTap tap_;
  peer::DatagramBalance balance_{tap_};
};

}  // namespace reckon::tools
