// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The talk with a serial board: it is asked what it is, and then told forces while it reports.
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

/// How far a board is.
enum class SerialStage : std::uint8_t {
  asked,    ///< has not greeted yet: no force
  refused,  ///< has greeted, and cannot be driven: no force
  greeted,  ///< has not reported yet: no force
  homing,   ///< its counts are no places yet: no force
  running,  ///< forces are shown
};

/// What is known of every serial board: nothing. 0.1 N s/m are assumed, nine tenths of which the
/// servo gets, and steps of 0.1 mm.
[[nodiscard]] const UsbFacts& serial_facts() noexcept;
/// [N], that boards are taken to hold where nobody says more.
inline constexpr double kSerialAssumedForce = 1.0;

/// The thread of its line alone calls it. While it runs it allocates nothing.
///
/// A board reports at its own rate, and takes up another force at the instant of a report only. It
/// tells the numbers of the force until then and from then on, so each way of the handle between
/// two reports that follow each other was under one force, which the servo's ledger books. Where
/// reports were lost, the servo's reading fails, and its ledger takes the worst that forces between
/// those numbers may have done. Where the board held a force that the servo did not write (a zero
/// in its place, or none), readings do not join: a new run begins.
class SerialSession {
 public:
  /// Of the servo. A zero is at the board 10 ms after the servo's last write.
  static constexpr std::chrono::microseconds kSilence{6500};
  /// Without a report for so long the board is told a zero.
  static constexpr std::chrono::milliseconds kLate{6};
  /// Without a report for so long it has to be asked anew.
  static constexpr std::chrono::milliseconds kLost{200};
  /// Between questions.
  static constexpr std::chrono::milliseconds kAsk{100};
  /// Boards that the opening of their line resets are silent for some two seconds.
  static constexpr std::chrono::milliseconds kPatience{4000};
  /// A frame goes out for each report, and where none comes after this time.
  static constexpr std::chrono::milliseconds kKeep{2};
  /// After so long its clock is held against ours.
  static constexpr std::chrono::seconds kTrial{4};

  /// @param exchange outlives it  @param limits that the servo relies on  @param run of the first
  /// readings  @param question number of the first question  @param now of its begin
  SerialSession(UsbExchange& exchange, const DeviceLimits& limits, std::uint32_t run,
                std::uint16_t question, std::chrono::nanoseconds now);

  /// Octets that came.
  void take(std::span<const std::uint8_t> octets, std::chrono::nanoseconds now);
  /// What to send now, if anything. Call while the line takes octets, and send it at once.
  [[nodiscard]] std::optional<SerialFrame> next(std::chrono::nanoseconds now);
  /// Of the end of the program: no force.
  [[nodiscard]] SerialFrame farewell() noexcept;

  [[nodiscard]] SerialStage stage() const noexcept { return stage_; }
  /// Whether the board has to be asked anew.
  [[nodiscard]] bool is_lost(std::chrono::nanoseconds now) const noexcept {
    return stage_ >= SerialStage::greeted && now - heard_at_ > kLost;
  }
  /// Whether nothing answers, for kPatience.
  [[nodiscard]] bool is_unanswered(std::chrono::nanoseconds now) const noexcept {
    return stage_ == SerialStage::asked && now - began_ > kPatience;
  }
  /// What was heard meanwhile was no frame, or none at all.
  [[nodiscard]] bool hears_noise() const noexcept { return parser_.damaged() > 0; }
  /// Why the board cannot be driven, with its remedy, as a sentence.
  [[nodiscard]] const std::string& refusal() const noexcept { return refusal_; }
  /// Valid from `greeted` on.
  [[nodiscard]] const SerialGreeting& greeting() const noexcept { return greeting_; }
  /// The line is gone: what was read tells no place any more. Its last call.
  void end_run() noexcept;
  /// Of the readings that it gives next.
  [[nodiscard]] std::uint32_t run() const noexcept { return run_; }

  /// Reports that were lost, and frames that were damaged, since the begin.
  [[nodiscard]] std::uint64_t lost() const noexcept { return lost_; }
  [[nodiscard]] std::uint64_t damaged() const noexcept { return parser_.damaged() + strange_; }
  /// Longest time from a write of the servo to the report that its force, or a later one, is held,
  /// over the first kTimed of them; 0: there were not so many yet.
  [[nodiscard]] std::chrono::nanoseconds chain() const noexcept {
    return timed_ < kTimed ? std::chrono::nanoseconds(0) : longest_;
  }
  static constexpr int kTimed = 500;

 private:
  // A frame that was sent: the write of the servo whose force it has.
  struct Sent {
    std::int64_t number = 0;
    std::chrono::nanoseconds at{0};  // of the write
    std::int64_t zero = 0;           // number of the last frame, of those to this one, that was a
                                     // zero in the place of the servo's force
  };
  static constexpr std::int64_t kKept = 256;  // frames

  void greet(std::span<const std::uint8_t> carried, std::chrono::nanoseconds now);
  void hear(const SerialReport& report, std::chrono::nanoseconds now);
  [[nodiscard]] bool follows(const SerialReport& report) noexcept;
  [[nodiscard]] bool keeps_time(std::chrono::nanoseconds now);
  void read(const SerialReport& report, std::chrono::nanoseconds now) noexcept;
  void leave() noexcept;
  void time(const Sent& held, const Sent& next, std::chrono::nanoseconds now) noexcept;
  [[nodiscard]] std::optional<std::int64_t> frame_at(std::uint16_t number) const noexcept;
  // Whether all frames from one to another have the servo's forces.
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

  std::array<Sent, kKept> frames_{};         // a ring
  std::int64_t told_ = 0;                    // number of the last frame, from 1
  bool answers_ = false;                     // a report came, and no frame went out since
  bool is_its_ = false;                      // of the last frame
  std::optional<SerialReport> last_;         // report
  std::chrono::nanoseconds clock_{0};        // the board's, of that
  std::chrono::nanoseconds first_heard_{0};  // of reports
  bool is_timed_ = false;                    // its clock was judged
  int let_go_ = 0;                           // of the last reading
  std::optional<std::int64_t> held_;  // frame of the last reading of this run; none: none yet
  std::uint64_t lost_ = 0, strange_ = 0;
  int timed_ = 0;
  std::chrono::nanoseconds longest_{0};
};

}  // namespace reckon::haptics
