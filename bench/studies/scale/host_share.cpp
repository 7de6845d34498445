// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/host_share.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <optional>
#include <system_error>

#include "reckon/bench/studies/scale/host_lines.hpp"
#include "reckon/bench/studies/scale/peer_processes.hpp"
#include "reckon/bench/studies/scale/whole_peer.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/interface_choice.hpp"

namespace reckon::bench {
namespace {

using std::chrono::nanoseconds;

/// The next line of stdin; none at its end. Reads octet by octet, to leave later lines unread.
std::optional<std::string> next_word() {
  std::string word;
  for (char octet = 0;;) {
    const ssize_t got = read(STDIN_FILENO, &octet, 1);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return std::nullopt;
    if (octet == '\n') return word;
    word += octet;
  }
}

/// False once stdin is closed, so the starter has ended. It sends no more words after the begin.
bool is_asked() {
  pollfd in{STDIN_FILENO, POLLIN, 0};
  return poll(&in, 1, 0) <= 0 || next_word().has_value();
}

void say(const tools::Console& console, std::string_view line) {
  fmt::print(console.out, "{}\n", line);
  std::fflush(console.out);
}

/// Fails now rather than after all hosts have begun.
void check_interface(const std::string& name) {
  try {
    static_cast<void>(peer::choose_interface(name, false));
  } catch (const std::system_error&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw tools::EnvironmentError(error.what());
  }
}

/// Answers clock words until the word to begin arrives; none if stdin ends before. Steady time.
std::optional<nanoseconds> asked_begin(const tools::Console& console) {
  const peer::SteadyClock clock;
  while (const auto word = next_word()) {
    const nanoseconds now = clock.now();
    if (const auto after = read_begin_word(*word)) return now + *after;
    if (*word != kClockWord)
      throw tools::UsageError(
          fmt::format("--share: unexpected '{}'; --whole hosts starts this verb itself on each "
                      "host: run --whole hosts",
                      *word));
    say(console, kClockLine);
  }
  return std::nullopt;
}

}  // namespace

HostShare read_host_share(const std::string& text) {
  std::size_t first = 0, last = 0;
  const std::size_t equals = std::min(text.find('='), text.size());
  const char* const end = text.data() + equals;
  const auto [dash, no_first] = std::from_chars(text.data(), end, first);
  const bool has_dash = no_first == std::errc() && dash != end && *dash == '-';
  const auto [rest, no_last] = std::from_chars(has_dash ? dash + 1 : end, end, last);
  if (no_last != std::errc() || rest != end || first < 1 || last < first)
    throw tools::UsageError(
        fmt::format("--share: '{}' is not FIRST-LAST, such as 1-16; --whole hosts starts this verb "
                    "itself on each host",
                    text));
  return {first - 1, last, text.substr(std::min(equals + 1, text.size()))};
}

void run_host_share(const ScaleSetting& setting, const HostShare& share,
                    const tools::Console& console) {
  if (share.end > setting.peers)
    throw tools::UsageError(
        fmt::format("--share: there is no peer {} among {}", share.end, setting.peers));
  check_interface(share.interface);
  ProcessPlan plan;
  plan.first = share.first;
  plan.count = share.end - share.first;
  plan.interface = share.interface;
  plan.seconds = kWarmUp + setting.seconds;
  plan.begin = [&] {
    say(console, ready_line(scale_scene(setting).hash));
    return asked_begin(console);
  };
  const auto task = [&](std::size_t peer, peer::Link& link, nanoseconds begin) {
    return live_for(setting, peer, link, begin, {0, plan.seconds});
  };
  std::size_t peer = share.first;
  for (const PeerProcess& process :
       run_peer_processes(plan, task, [&](double) { return is_asked() && !console.stopped(); }))
    say(console, peer_line(peer++, process));
}

}  // namespace reckon::bench
