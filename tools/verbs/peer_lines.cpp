// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/verbs/peer_lines.hpp"

#include "reckon/pdu/seconds.hpp"
#include "reckon/tools/exercise/balance_report.hpp"
#include "reckon/tools/terminal/json_text.hpp"

namespace reckon::tools {

void print_line(std::FILE* out, const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), out);
  std::fflush(out);
}

void print_notice(std::FILE* out, peer::NoticeKind kind, peer::Severity severity,
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

void BalanceLines::tell(const RunningPeer& running, bool end) {
  const double seconds = pdu::to_seconds(running.elapsed());
  print_line(out_, balance_line(balance_.report(running.now(), end), seconds, end));
}

}  // namespace reckon::tools
