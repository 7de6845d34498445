// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/tools/captures/exercise_map.hpp"
#include "reckon/tools/captures/replay_keys.hpp"
#include "reckon/tools/captures/replay_reach.hpp"
#include "reckon/tools/captures/replay_schedule.hpp"
#include "reckon/tools/captures/replay_senders.hpp"
#include "reckon/tools/captures/timestamp_rewrite.hpp"
#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/command_line/duration_text.hpp"
#include "reckon/tools/command_line/size_text.hpp"
#include "reckon/tools/command_line/status_line.hpp"
#include "reckon/tools/command_line/verb_rows.hpp"
#include "reckon/tools/datagrams/sealed_datagrams.hpp"
#include "reckon/tools/datagrams/selection.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/keys.hpp"
#include "reckon/tools/terminal/text_table.hpp"
#include "reckon/tools/verbs/replay_options.hpp"

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

/// A long wait is split into pieces of this length, so that Ctrl-C takes effect.
constexpr nanoseconds kPatience = std::chrono::milliseconds(100);

/// Interval between reads of the keys while datagrams follow each other closely.
constexpr nanoseconds kKeyPeriod = std::chrono::milliseconds(50);

struct ReplayCounts {
  std::uint64_t sent = 0;
  std::uint64_t octets = 0;
  std::uint64_t incomplete = 0;  ///< fragments are missing, or the capture truncated them
  std::uint64_t not_chosen = 0;  ///< excluded by the options
  std::uint64_t refused = 0;     ///< by the kernel
  nanoseconds latest{};          ///< greatest lateness
};

/// One run of the verb.
class Replay {
 public:
  Replay(const ReplayOptions& options, const Console& console)
      : options_(options),
        console_(console),
        selection_(options.selection),
        sealed_(options.key),
        map_(options.map, options.selection.lenient),
        source_(open_recording(options.file)),
        senders_(options.interface, options.broadcast, clock_),
        status_(console.err, clock_.now()),
        terminal_(keys_descriptor(options, console)) {}

  void run();
  [[nodiscard]] ExitCode summarise() const;

 private:
  void play_lap();
  [[nodiscard]] bool unseal(peer::SourceDatagram& datagram);
  void play(const peer::SourceDatagram& datagram);
  void send(const peer::SourceDatagram& datagram);
  void begin(const peer::SourceDatagram& datagram);
  [[nodiscard]] bool wait_for_turn();
  void take_keys(nanoseconds patience);
  void show_status(nanoseconds now);
  [[nodiscard]] bool has_ended() const { return ended_ || console_.stopped(); }
  [[nodiscard]] peer::IpEndpoint destination(const peer::SourceDatagram& datagram) const;
  [[nodiscard]] std::string speed_text() const;
  void add_counts(JsonObject& line, std::string_view event, nanoseconds now) const;
  void report_refusal() const;
  [[nodiscard]] static int keys_descriptor(const ReplayOptions& options, const Console& console);

  const ReplayOptions& options_;
  const Console& console_;
  CaptureSelection selection_;
  SealedDatagrams sealed_;
  ExerciseMap map_;
  std::unique_ptr<peer::DatagramSource> source_;
  peer::SteadyClock clock_;
  ReplaySenders senders_;
  ReplayReach reach_;
  StatusLine status_;
  TerminalKeys terminal_;
  ReplayKeys keys_;
  nanoseconds looked_{};                    ///< last read of the keys
  std::optional<ReplaySchedule> schedule_;  ///< from the first datagram on
  nanoseconds begin_{};                     ///< send time of the first datagram
  nanoseconds end_{};                       ///< send time of the last datagram
  nanoseconds finished_{};
  bool read_again_ = false;
  bool ended_ = false;  ///< by a key
  std::uint64_t laps_ = 0;
  ReplayCounts counts_;
  std::vector<std::byte> buffer_;
};

// Keys need a terminal, for input and for output.
int Replay::keys_descriptor(const ReplayOptions& options, const Console& console) {
  const bool seen = isatty(fileno(console.err)) == 1;
  return seen && can_be_read_again(options.file) ? STDIN_FILENO : -1;
}

void Replay::run() {
  if (terminal_.is_active()) fmt::print(console_.err, "{}\n", ReplayKeys::kHelp);
  while (!has_ended()) {
    const std::uint64_t before = counts_.sent + counts_.refused;
    play_lap();
    ++laps_;
    if (laps_ == options_.loop || counts_.sent + counts_.refused == before || has_ended()) break;
    schedule_->next_lap(clock_.now());
    source_ = open_recording(options_.file);
  }
  finished_ = clock_.now();
  status_.clear();
}

void Replay::play_lap() {
  peer::SourceDatagram datagram;
  while (!has_ended() && source_->next(datagram, {}) == peer::SourceEvent::datagram) {
    if (!unseal(datagram)) continue;
    if (!selection_.takes(datagram)) {
      ++counts_.not_chosen;
      continue;
    }
    if (datagram.portion == peer::Portion::whole)
      play(datagram);
    else
      ++counts_.incomplete;
    if (!std::exchange(read_again_, false)) continue;
    counts_.incomplete = counts_.not_chosen = 0;  // they will be counted again
    source_ = open_recording(options_.file);
  }
}

// @return whether there is a datagram to send. An opened datagram is sent to its plain destination,
// the next lower port.
bool Replay::unseal(peer::SourceDatagram& datagram) {
  const std::span<const std::byte> sealed = datagram.bytes;
  const bool is_read = sealed_.open(datagram);
  if (options_.key.empty()) return true;
  const bool was_sealed = is_read && datagram.bytes.data() != sealed.data();
  if (was_sealed) --datagram.group.port;
  return is_read;
}

void Replay::play(const peer::SourceDatagram& datagram) {
  if (!schedule_.has_value()) begin(datagram);
  schedule_->next(datagram.time);
  if (!wait_for_turn()) return;
  send(datagram);
  end_ = clock_.now();
  if (options_.rate > 0) counts_.latest = std::max(counts_.latest, end_ - schedule_->due());
  schedule_->sent(end_);
  if (status_.due(end_)) show_status(end_);
}

void Replay::begin(const peer::SourceDatagram& datagram) {
  if (options_.interface == kRecorded) senders_.use(recorded_interface(*source_));
  senders_.prepare(destination(datagram));
  reach_.note(destination(datagram));
  fmt::print(console_.err, "sending to {}\n", reach_.text(senders_.interface()));
  begin_ = looked_ = clock_.now();
  schedule_.emplace(options_.rate, begin_);
}

// False if the datagram is not to be sent: skipped by a jump, or the end was requested.
bool Replay::wait_for_turn() {
  while (!has_ended() && !schedule_->is_skipped()) {
    const nanoseconds now = clock_.now();
    const bool paused = schedule_->is_paused();
    const nanoseconds left = paused ? kPatience : schedule_->due() - now;
    const bool look = terminal_.is_active() && now - looked_ >= kKeyPeriod;
    if (left <= nanoseconds::zero() && !look) return true;
    if (status_.due(now)) show_status(now);
    take_keys(std::clamp(left, nanoseconds::zero(), kPatience));
    if (read_again_) return false;
  }
  return false;
}

void Replay::take_keys(nanoseconds patience) {
  std::array<char, 32> keys{};
  const std::size_t count = terminal_.read(keys, patience);
  looked_ = clock_.now();
  for (const char key : std::span(keys).first(count)) {
    const ReplayKeys::Demand demand = keys_.press(key, *schedule_, looked_);
    if (demand == ReplayKeys::Demand::end) ended_ = true;
    if (demand == ReplayKeys::Demand::read_again) read_again_ = true;
  }
  if (count > 0 && !ended_) show_status(looked_);
}

void Replay::show_status(nanoseconds now) {
  status_.show(fmt::format("at {}: {} sent, {}{}", duration_text(schedule_->position(now)),
                           counted(counts_.sent, "datagram"), speed_text(),
                           schedule_->is_paused() ? "; paused" : ""),
               now);
  if (!options_.json) return;
  std::string text;
  JsonObject line(text);
  add_counts(line, "status", now);
  line.end("\n");
  fmt::print(console_.out, "{}", text);
  std::fflush(console_.out);
}

void Replay::send(const peer::SourceDatagram& datagram) {
  std::span<const std::byte> bytes = datagram.bytes;
  if (options_.rewrite_time || map_.is_active()) {
    buffer_.assign(bytes.begin(), bytes.end());
    if (options_.rewrite_time) rewrite_timestamps(buffer_, clock_.utc_now());
    map_.apply(buffer_);
    bytes = buffer_;
  }
  reach_.note(destination(datagram));
  if (!senders_.send(destination(datagram), bytes)) {
    ++counts_.refused;
    return;
  }
  ++counts_.sent;
  counts_.octets += bytes.size();
}

peer::IpEndpoint Replay::destination(const peer::SourceDatagram& datagram) const {
  if (options_.destination.has_value()) return *options_.destination;
  if (datagram.group.is_multicast() && datagram.group.port != 0) return datagram.group;
  throw UsageError(
      fmt::format("frame {} was sent to {}, which is not a multicast group; write a destination, "
                  "for example --to udp://239.192.1.0:3000 or --to udp://127.0.0.1:3000",
                  datagram.frame, datagram.group.text()));
}

std::string Replay::speed_text() const {
  const double rate = schedule_ ? schedule_->asked() : options_.rate;
  std::string text =
      rate > 0 ? fmt::format("requested {:.4g}x", rate) : "requested as fast as possible";
  if (schedule_ && schedule_->is_changed()) text += " on average by keys";
  // There is no rate without two sent datagrams.
  if (counts_.sent < 2 || schedule_->kept() <= 0) return text;
  return text + fmt::format(", got {:.4g}x", schedule_->kept());
}

void Replay::add_counts(JsonObject& line, std::string_view event, nanoseconds now) const {
  const bool begun = schedule_.has_value();
  line.text("event", event)
      .decimals("seconds", begun ? pdu::to_seconds(now - begin_) : 0.0, 3)
      .decimals("position", begun ? pdu::to_seconds(schedule_->position(now)) : 0.0, 3)
      .value("datagrams", counts_.sent)
      .value("octets", counts_.octets)
      .value("refused", counts_.refused)
      .value("too_big", std::min(counts_.refused, senders_.too_big()))
      .value("fragmented", senders_.fragmented())
      .value("incomplete", counts_.incomplete)
      .value("not_chosen", counts_.not_chosen)
      .value("mapped", map_.counts().mapped)
      .value("asked", fmt::format("{:.6g}", begun ? schedule_->asked() : options_.rate))
      .value("got", counts_.sent > 1 && schedule_->kept() > 0
                        ? fmt::format("{:.6g}", schedule_->kept())
                        : "null")
      .decimals("late", pdu::to_seconds(counts_.latest), 6)
      .decimals("paused", begun ? pdu::to_seconds(schedule_->paused(now)) : 0.0, 3);
}

void Replay::report_refusal() const {
  const std::uint64_t too_big = std::min(counts_.refused, senders_.too_big());
  fmt::print(console_.err, "{} not sent: {} too big for {}, {} refused by the kernel{}\n",
             counted(counts_.refused, "datagram"), too_big, senders_.interface(),
             counts_.refused - too_big,
             senders_.interface() == "lo"
                 ? "; lo reaches only this host, choose another with --iface"
                 : "; is there a route to it?");
}

ExitCode Replay::summarise() const {
  fmt::print(console_.err, "replayed {} ({}) in {} to {}; {}", counted(counts_.sent, "datagram"),
             size_text(counts_.octets), duration_text(end_ - begin_),
             reach_.text(senders_.interface()), speed_text());
  if (options_.rate > 0 && counts_.sent > 0)
    fmt::print(console_.err, "; at most {} late", duration_text(counts_.latest));
  fmt::print(console_.err, "\n");
  if (counts_.not_chosen > 0)
    fmt::print(console_.err, "{} left out: not selected by the flags\n",
               counted(counts_.not_chosen, "datagram"));
  if (counts_.incomplete > 0)
    fmt::print(console_.err, "{} left out: with missing IP fragments, or cut by the capture\n",
               counted(counts_.incomplete, "datagram"));
  if (senders_.fragmented() > 0)
    fmt::print(console_.err, "{} sent in IP fragments: above the MTU of {}, {} octets\n",
               counted(senders_.fragmented(), "datagram"), senders_.interface(), senders_.mtu());
  if (counts_.refused > 0) report_refusal();
  fmt::print(console_.err, "{}{}", map_.summary(), sealed_.summary());
  const std::string& problem = source_->report().problem;
  if (!problem.empty()) fmt::print(console_.err, "{}\n", problem);
  if (options_.json) {
    std::string text;
    JsonObject line(text);
    add_counts(line, "summary", finished_);
    line.value("laps", laps_).text("problem", problem).end("\n");
    fmt::print(console_.out, "{}", text);
  }
  if (counts_.sent + counts_.refused + counts_.incomplete == 0 && !has_ended())
    fmt::print(console_.err, "nothing to send; `reckon info {}` shows the contents\n",
               options_.file);
  if (counts_.sent == 0 && counts_.refused > 0) return ExitCode::environment;
  const bool whole = problem.empty() && counts_.incomplete == 0 && counts_.refused == 0;
  return whole || has_ended() ? ExitCode::good : ExitCode::findings;
}

int run_replay(Arguments arguments, const Console& console) {
  ReplayOptions options;
  if (const auto status = parse_replay(arguments, console, options)) return *status;

  Replay replay(options, console);
  replay.run();
  return exit_status(replay.summarise());
}

}  // namespace

namespace verb {

Verb replay() { return verb_of(verb_row("replay"), run_replay); }

}  // namespace verb

}  // namespace reckon::tools
