// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The protocol with a serial board: it identifies itself, then receives forces and sends reports.
// Pure: octets and time are passed in.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "reckon/haptics/devices/haptic_device.hpp"
#include "reckon/haptics/serial/serial_frames.hpp"
#include "reckon/haptics/serial/serial_packets.hpp"
#include "reckon/haptics/usb/usb_exchange.hpp"
#include "reckon/haptics/usb/usb_limits.hpp"

namespace reckon::haptics {

/// Stage of a session.
enum class SerialStage : std::uint8_t {
  asked,    ///< no greeting yet: no force
  refused,  ///< the board has greeted and cannot be used: no force
  greeted,  ///< no report yet: no force
  homing,   ///< its counts are no positions yet: no force
  running,  ///< forces are shown
};

/// Assumptions about all serial boards, of which nothing is known: a damping of 0.1 N s/m, nine
/// tenths of it for the servo, and steps of 0.1 mm.
[[nodiscard]] const UsbFacts& serial_facts() noexcept;
/// Assumed greatest force of a board [N], unless the user states another.
inline constexpr double kSerialAssumedForce = 1.0;

/// For the thread of its line only. It allocates nothing while the stage is `running`.
///
/// A board reports at its own rate, and changes its force only at the instant of a report. A report
/// has the numbers of the force until then and of the force from then on. So one force acts on the
/// motion between two consecutive reports, and the servo's ledger books it. If reports were lost,
/// the servo's reading fails, and its ledger books the worst case of the forces between those
/// numbers. If the board held a force that the servo did not write (a zero in its place, or none),
/// a new run of readings begins.
class SerialSession {
 public:
  /// The servo's silence after which a zero force is sent. It is at the board 10 ms after the
  /// servo's last write.
  static constexpr std::chrono::microseconds kSilence{6500};
  /// Without a report for so long, the board is sent a zero force.
  static constexpr std::chrono::milliseconds kLate{6};
  /// Without a report for so long, the board must identify itself again.
  static constexpr std::chrono::milliseconds kLost{200};
  /// Interval of ask frames.
  static constexpr std::chrono::milliseconds kAsk{100};
  /// Time for a first answer. Boards that reset when the port is opened are silent for about two
  /// seconds.
  static constexpr std::chrono::milliseconds kPatience{4000};
  /// A frame is sent after each report, and after this time without a report.
  static constexpr std::chrono::milliseconds kKeep{2};
  /// After so long, the board's clock is compared with the host's.
  static constexpr std::chrono::seconds kTrial{4};

  /// @param exchange outlives it @param limits that the servo relies on @param run of the first
  /// readings @param question number of the first ask frame @param now start of the session
  SerialSession(UsbExchange& exchange, const DeviceLimits& limits, std::uint32_t run,
                std::uint16_t question, std::chrono::nanoseconds now);

  /// Decodes received octets.
  void take(std::span<const std::uint8_t> octets, std::chrono::nanoseconds now);
  /// The frame to send now, if any. Call only while the line accepts octets, and send it at once.
  [[nodiscard]] std::optional<SerialFrame> next(std::chrono::nanoseconds now);
  /// The last frame of the program: zero force.
  [[nodiscard]] SerialFrame farewell() noexcept;

  [[nodiscard]] SerialStage stage() const noexcept { return stage_; }
  /// Whether the board must identify itself again.
  [[nodiscard]] bool is_lost(std::chrono::nanoseconds now) const noexcept {
    return stage_ >= SerialStage::greeted && now - heard_at_ > kLost;
  }
  /// Whether the board has not answered for kPatience.
  [[nodiscard]] bool is_unanswered(std::chrono::nanoseconds now) const noexcept {
    return stage_ == SerialStage::asked && now - began_ > kPatience;
  }
  /// Whether damaged frames were received.
  [[nodiscard]] bool hears_noise() const noexcept { return parser_.damaged() > 0; }
  /// Why the board cannot be used, with its remedy, as a sentence.
  [[nodiscard]] const std::string& refusal() const noexcept { return refusal_; }
  /// Valid from stage `greeted` on.
  [[nodiscard]] const SerialGreeting& greeting() const noexcept { return greeting_; }
  /// Ends the run: the connection is lost, and earlier readings are invalid. Only farewell() and
  /// run() may follow.
  void end_run() noexcept;
  /// Run number of the next readings.
  [[nodiscard]] std::uint32_t run() const noexcept { return run_; }

  /// Lost reports, and damaged frames, since the start.
  [[nodiscard]] std::uint64_t lost() const noexcept { return lost_; }
  [[nodiscard]] std::uint64_t damaged() const noexcept { return parser_.damaged() + strange_; }
  /// Longest time from a write of the servo to the report that its force or a later one is held,
  /// over the first kTimed writes; 0: fewer so far.
  [[nodiscard]] std::chrono::nanoseconds chain() const noexcept {
    return timed_ < kTimed ? std::chrono::nanoseconds(0) : longest_;
  }
  static constexpr int kTimed = 500;

 private:
  // A sent frame and the servo's write whose force it carries.
  struct Sent {
    std::int64_t number = 0;
    std::chrono::nanoseconds at{0};  // time of the write
    std::int64_t zero =
        0;  // the newest frame up to this one with a zero in place of the servo's force
  };
  static constexpr std::int64_t kKept = 256;  // frames

  void greet(std::span<const std::uint8_t> carried, std::chrono::nanoseconds now);
  void receive(const SerialReport& report, std::chrono::nanoseconds now);
  [[nodiscard]] bool follows(const SerialReport& report) noexcept;
  [[nodiscard]] bool keeps_time(std::chrono::nanoseconds now);
  void read(const SerialReport& report, std::chrono::nanoseconds now) noexcept;
  void leave() noexcept;
  void time(const Sent& held, const Sent& next, std::chrono::nanoseconds now) noexcept;
  [[nodiscard]] std::optional<std::int64_t> frame_at(std::uint16_t number) const noexcept;
  // Whether all frames of a range carry the servo's forces.
  [[nodiscard]] bool are_its(std::int64_t first, std::int64_t last) const noexcept {
    return sent(last).zero < first;
  }
  [[nodiscard]] const Sent& sent(std::int64_t frame) const noexcept {
    return frames_[static_cast<std::size_t>(frame % kKept)];
  }
  [[nodiscard]] Eigen::Vector3d place_of(const SerialReport& report) const noexcept;
  [[nodiscard]] SerialForce force_of(const Eigen::Vector3d& force) const noexcept;
  [[nodiscard]] SerialFrame tell(const UsbForce& force, bool is_its) noexcept;

  UsbExchange& exchange_;
  double max_force_, resolution_;
  std::uint32_t run_;
  std::uint16_t question_, questions_ = 0;
  std::chrono::nanoseconds began_, heard_at_, next_ask_{0}, sent_at_{0};
  SerialFrameParser parser_;
  SerialStage stage_ = SerialStage::asked;
  SerialGreeting greeting_;
  std::string refusal_;

  std::array<Sent, kKept> frames_{};         // ring buffer
  std::int64_t told_ = 0;                    // number of the last frame sent, from 1
  bool answers_ = false;                     // a report was received, and no frame sent since
  bool is_its_ = false;                      // the last frame carried the servo's force
  std::optional<SerialReport> last_;         // last report in order
  std::chrono::nanoseconds clock_{0};        // board's clock at that report
  std::chrono::nanoseconds first_heard_{0};  // time of the first report
  bool is_timed_ = false;                    // the board's clock has been checked
  int drops_ = 0;                            // force_drops of the last reading
  std::optional<std::int64_t>
      held_;  // frame of the last reading of this run; std::nullopt: none yet
  std::uint64_t lost_ = 0, strange_ = 0;
  int timed_ = 0;
  std::chrono::nanoseconds longest_{0};
};

}  // namespace reckon::haptics
