// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The JSON lines that `reckon peer` prints while it runs.
#pragma once

#include <chrono>
#include <cstdio>
#include <string>
#include <string_view>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/loops/notice.hpp"
#include "reckon/peer/network/datagram_balance.hpp"
#include "reckon/tools/exercise/balance_report.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/verbs/running_peer.hpp"

namespace reckon::tools {

/// Flushes at once, for readers of a pipe.
inline void print_line(std::FILE* out, const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), out);
  std::fflush(out);
}
inline void print_notice(std::FILE* out, peer::NoticeKind kind, peer::Severity severity,
                         std::string_view text, double seconds) {
  std::string line;
  JsonObject(line)
      .text("event", "notice")
      .decimals("seconds", seconds, 3)
      .text("text", text)
      .text("notice", peer::facts_of(kind).id)
      .text("severity", peer::name_of(severity))
      .end("\n");
  print_line(out, line);
}

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
  void tell(const RunningPeer& running, bool end) {
    const double seconds = pdu::to_seconds(running.elapsed());
    print_line(out_, balance_line(balance_.report(running.now(), end), seconds, end));
  }

  std::chrono::nanoseconds every_, next_;
  std::FILE* out_;
  peer::DatagramTap tap_;
  peer::DatagramBalance balance_{tap_};
};

}  // namespace reckon::tools
