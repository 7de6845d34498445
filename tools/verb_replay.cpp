// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/verb_replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "src/clock.hpp"
#include "src/udp_multicast.hpp"
#include "tools/capture_selection.hpp"
#include "tools/command_line.hpp"
#include "tools/duration_text.hpp"
#include "tools/replay_schedule.hpp"
#include "tools/size_text.hpp"
#include "tools/status_line.hpp"
#include "tools/text_table.hpp"
#include "tools/timestamp_rewrite.hpp"

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

/// A long wait is cut into such pieces, so that Ctrl-C is heeded.
constexpr nanoseconds kPatience = std::chrono::milliseconds(100);

constexpr std::string_view kSummary =
    "Sends a capture's datagrams again, at the times at which they were recorded.\n\n"
    "They reach every program of this host that has joined their groups; with --iface also the\n"
    "network there. FILE is pcap or pcapng. At the end it tells the speed that it kept.";
constexpr std::string_view kExamples =
    "reckon replay exercise.pcapng\n"
    "reckon replay exercise.pcapng --rate 4 --from 90s --to-time 2min\n"
    "reckon replay exercise.pcapng --to udp://239.1.2.3:3000 --iface eth0 --rewrite-time\n"
    "reckon replay exercise.pcapng --loop 0 --entity 1:2:*";

struct ReplayOptions {
  std::string file;
  std::string to;
  std::string interface = "lo";
  double rate = 1.0;
  std::uint64_t loop = 1;
  bool rewrite_time = false;
  SelectionOptions selection;
};

struct ReplayCounts {
  std::uint64_t sent = 0;
  std::uint64_t octets = 0;
  std::uint64_t incomplete = 0;  ///< fragments and frames that the capture cut
  std::uint64_t refused = 0;     ///< by the kernel
  nanoseconds latest{};          ///< greatest lateness
};

std::optional<peer::IpEndpoint> parse_destination(const std::string& text) {
  if (text.empty()) return std::nullopt;
  constexpr std::string_view kUdp = "udp://";
  std::string_view address = text;
  if (address.starts_with(kUdp)) address.remove_prefix(kUdp.size());
  const auto endpoint = peer::IpEndpoint::parse(address, peer::GroupPool::kDefaultPort);
  if (!endpoint.has_value() || endpoint->port == 0)
    throw UsageError(fmt::format(
        "--to {}: no destination; write udp://239.192.1.0:3000 or udp://127.0.0.1:3000", text));
  return endpoint;
}

/// The sockets of a replay: one for each address family, opened when it is needed.
class Senders {
 public:
  Senders(std::string interface, const peer::Clock& clock)
      : interface_(std::move(interface)), clock_(clock) {}

  /// Opens the socket that reaches `to`. Throws EnvironmentError where that cannot be.
  void prepare(const peer::IpEndpoint& to) {
    auto& link = links_[to.is_v6 ? 1 : 0];
    if (!link) link = open(to.is_v6);
  }
  bool send(const peer::IpEndpoint& to, std::span<const std::byte> bytes) {
    prepare(to);
    return links_[to.is_v6 ? 1 : 0]->send(to, bytes);
  }
  [[nodiscard]] std::uint64_t too_big() const {
    std::uint64_t count = 0;
    for (const auto& link : links_) count += link ? link->statistics().too_big : 0;
    return count;
  }

 private:
  [[nodiscard]] std::unique_ptr<peer::UdpMulticast> open(bool ipv6) const {
    peer::UdpMulticastOptions options;
    options.interface = interface_;
    options.ipv6 = ipv6;
    options.max_groups = 1;
    try {
      return std::make_unique<peer::UdpMulticast>(options, clock_);
    } catch (const std::runtime_error& error) {
      throw EnvironmentError(error.what());
    }
  }

  std::string interface_;
  const peer::Clock& clock_;
  std::array<std::unique_ptr<peer::UdpMulticast>, 2> links_;
};

/// One run of the verb.
class Replay {
 public:
  Replay(const ReplayOptions& options, const Console& console)
      : options_(options),
        console_(console),
        to_(parse_destination(options.to)),
        selection_(options.selection),
        source_(open_recording(options.file)),
        senders_(options.interface, clock_),
        status_(console.err, clock_.now()) {}

  void run();
  [[nodiscard]] ExitCode summarise() const;

 private:
  void play_lap();
  void play(const peer::SourceDatagram& datagram);
  void send(const peer::SourceDatagram& datagram);
  [[nodiscard]] peer::IpEndpoint destination(const peer::SourceDatagram& datagram) const;
  void wait_until(nanoseconds due) const;
  [[nodiscard]] std::string speed_text() const;
  void tell_refused() const;

  const ReplayOptions& options_;
  const Console& console_;
  std::optional<peer::IpEndpoint> to_;
  CaptureSelection selection_;
  std::unique_ptr<peer::DatagramSource> source_;
  peer::SteadyClock clock_;
  Senders senders_;
  StatusLine status_;
  std::optional<ReplaySchedule> schedule_;  ///< from the first datagram on
  nanoseconds begin_{};                     ///< when the first datagram went out
  nanoseconds end_{};                       ///< when the last one did
  ReplayCounts counts_;
  std::vector<std::byte> buffer_;
};

void Replay::run() {
  for (std::uint64_t lap = 1; !console_.stopped(); ++lap) {
    const std::uint64_t before = counts_.sent + counts_.refused;
    play_lap();
    if (lap == options_.loop || counts_.sent + counts_.refused == before) break;
    if (console_.stopped()) break;
    schedule_->next_lap();
    source_ = open_recording(options_.file);
  }
  status_.clear();
}

void Replay::play_lap() {
  peer::SourceDatagram datagram;
  while (!console_.stopped() && source_->next(datagram, {}) == peer::SourceEvent::datagram) {
    if (!selection_.takes(datagram)) continue;
    if (datagram.portion == peer::Portion::whole)
      play(datagram);
    else
      ++counts_.incomplete;
  }
}

void Replay::play(const peer::SourceDatagram& datagram) {
  if (!schedule_.has_value()) {
    senders_.prepare(destination(datagram));
    begin_ = clock_.now();
    schedule_.emplace(options_.rate, begin_);
  }
  const nanoseconds due = schedule_->due(datagram.time);
  wait_until(due);
  if (console_.stopped()) return;
  send(datagram);
  end_ = clock_.now();
  if (options_.rate > 0) counts_.latest = std::max(counts_.latest, end_ - due);
  if (status_.due(end_))
    status_.show(fmt::format("{}: {} sent, {}", duration_text(end_ - begin_),
                             counted(counts_.sent, "datagram"), speed_text()),
                 end_);
}

void Replay::send(const peer::SourceDatagram& datagram) {
  std::span<const std::byte> bytes = datagram.bytes;
  if (options_.rewrite_time) {
    buffer_.assign(bytes.begin(), bytes.end());
    rewrite_timestamps(buffer_, clock_.utc_now());
    bytes = buffer_;
  }
  if (!senders_.send(destination(datagram), bytes)) {
    ++counts_.refused;
    return;
  }
  ++counts_.sent;
  counts_.octets += bytes.size();
}

peer::IpEndpoint Replay::destination(const peer::SourceDatagram& datagram) const {
  if (to_.has_value()) return *to_;
  if (datagram.group.is_multicast() && datagram.group.port != 0) return datagram.group;
  throw UsageError(fmt::format(
      "frame {} was sent to {}, which is no multicast group; say where it shall go, as in --to "
      "udp://239.192.1.0:3000 or --to udp://127.0.0.1:3000",
      datagram.frame, datagram.group.text()));
}

void Replay::wait_until(nanoseconds due) const {
  for (nanoseconds left = due - clock_.now(); left > nanoseconds::zero() && !console_.stopped();
       left = due - clock_.now())
    std::this_thread::sleep_for(std::min(left, kPatience));
}

std::string Replay::speed_text() const {
  const std::string asked =
      options_.rate > 0 ? fmt::format("{:g}x", options_.rate) : "as fast as it goes";
  const double elapsed = std::chrono::duration<double>(end_ - begin_).count();
  const double played =
      schedule_ ? std::chrono::duration<double>(schedule_->played()).count() : 0.0;
  // Without two datagrams sent there is no speed.
  if (counts_.sent < 2 || elapsed <= 0 || played <= 0) return fmt::format("asked {}", asked);
  return fmt::format("asked {}, got {:.4g}x", asked, played / elapsed);
}

void Replay::tell_refused() const {
  const std::uint64_t too_big = std::min(counts_.refused, senders_.too_big());
  fmt::print(console_.err, "{} not sent: {} too big for {}, {} refused by the kernel{}\n",
             counted(counts_.refused, "datagram"), too_big, options_.interface,
             counts_.refused - too_big,
             options_.interface == "lo" ? "; lo reaches this host only, --iface names another"
                                        : "; is there a route to it?");
}

ExitCode Replay::summarise() const {
  fmt::print(console_.err, "replayed {} ({}) in {}; {}", counted(counts_.sent, "datagram"),
             size_text(counts_.octets), duration_text(end_ - begin_), speed_text());
  if (options_.rate > 0 && counts_.sent > 0)
    fmt::print(console_.err, "; at most {} late", duration_text(counts_.latest));
  fmt::print(console_.err, "\n");
  if (counts_.incomplete > 0)
    fmt::print(console_.err, "{} left out: fragments, or cut by the capture\n",
               counted(counts_.incomplete, "datagram"));
  if (counts_.refused > 0) tell_refused();
  const std::string& problem = source_->report().problem;
  if (!problem.empty()) fmt::print(console_.err, "{}\n", problem);
  if (counts_.sent + counts_.refused + counts_.incomplete == 0 && !console_.stopped())
    fmt::print(console_.err, "nothing to send; `reckon info {}` shows what there is\n",
               options_.file);
  if (counts_.sent == 0 && counts_.refused > 0) return ExitCode::environment;
  const bool whole = problem.empty() && counts_.incomplete == 0 && counts_.refused == 0;
  return whole || console_.stopped() ? ExitCode::good : ExitCode::findings;
}

void check(const ReplayOptions& options) {
  if (!std::isfinite(options.rate) || options.rate < 0)
    throw UsageError(fmt::format(
        "--rate {}: write a number above 0 (2 is twice as fast), or 0 for as fast as it goes",
        options.rate));
  if (options.file == "-" && options.loop != 1)
    throw UsageError("standard input can be played only once; save it to a file for --loop");
}

}  // namespace

int run_replay(Arguments arguments, const Console& console) {
  ReplayOptions options;
  CommandLine line("replay", kSummary, kExamples);
  line.word("FILE", options.file, true, "the capture; - is stdin");
  line.option("--to", options.to,
              "send all to udp://GROUP:PORT or udp://HOST:PORT (default: where it was sent)");
  line.option("--iface", options.interface, "interface to send on (default: lo, this host only)");
  line.option("--rate", options.rate, "how fast, 2 is twice as fast; 0 as fast as it goes");
  line.option("--loop", options.loop, "play it so many times; 0 until Ctrl-C");
  options.selection.declare(line, "--to-time");
  line.flag("--rewrite-time", options.rewrite_time,
            "set the PDUs' timestamps to the time of sending");
  if (const auto status = line.parse(arguments, console)) return *status;
  check(options);

  Replay replay(options, console);
  replay.run();
  return exit_status(replay.summarise());
}

}  // namespace reckon::tools
