// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Encodes the reports of the class PID (Physical Interface Devices 1.0) that render springs, and
// decodes its input reports of position and buttons. Pure: no calls of the system.
#pragma once

#include <linux/input.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reckon/haptics/evdev/condition_effect.hpp"
#include "reckon/haptics/evdev/event_state.hpp"
#include "reckon/haptics/hid/report_descriptor.hpp"

namespace reckon::haptics {

/// A report that begins with its ID.
class HidReport {
 public:
  static constexpr std::size_t kMost = 256;  ///< octets

  HidReport() = default;
  /// @param octets at most kMost, at least 1
  HidReport(std::uint8_t number, std::size_t octets) noexcept : size_(octets) {
    octets_[0] = number;
  }

  [[nodiscard]] std::span<std::uint8_t> span() noexcept { return {octets_.data(), size_}; }
  [[nodiscard]] std::span<const std::uint8_t> span() const noexcept {
    return {octets_.data(), size_};
  }

 private:
  std::array<std::uint8_t, kMost> octets_{};
  std::size_t size_ = 0;
};

/// Position and buttons of the device, from its input reports.
struct HidPlaces {
  std::array<std::int32_t, EventState::kAxes> axes{};  ///< position, in device units
  std::array<bool, EventState::kAxes> is_known{};      ///< a report has held the axis
  std::uint32_t buttons = 0;                           ///< bit i: button i + 1 is down
  bool operator==(const HidPlaces&) const = default;
};

/// The device's answer to the creation of an effect (PID Block Load).
struct PidLoad {
  enum class Outcome : std::uint8_t { none, done, full, failed };
  Outcome outcome = Outcome::none;
  std::uint8_t block = 0;  ///< effect block index, for all later reports of the effect
};

/// Commands to a device and to one of its effects: usages of the page PID.
enum class PidControl : std::uint8_t { enable = 0x97, stop_all = 0x99, reset = 0x9A };
enum class PidOperation : std::uint8_t { start = 0x79, stop = 0x7B };

/// Built once from a descriptor. The reports that it then makes take no heap. Optional fields that
/// the descriptor lacks are left out; fault() names a required one that is missing.
class PidReports {
 public:
  explicit PidReports(const HidReports& reports);

  /// Whether the device renders any effect.
  [[nodiscard]] bool gives_forces() const noexcept { return gives_forces_; }
  [[nodiscard]] bool has_springs() const noexcept { return create_.spring.has_value(); }
  [[nodiscard]] bool has_constant_forces() const noexcept { return has_constant_forces_; }
  /// Why it cannot render the springs that walls need, as a sentence; empty: it can.
  [[nodiscard]] const std::string& fault() const noexcept { return fault_; }
  /// Ranges of X and Y; std::nullopt: the device lacks the axis.
  [[nodiscard]] const std::array<std::optional<EventAxis>, EventState::kAxes>& axes()
      const noexcept {
    return ranges_;
  }
  [[nodiscard]] std::size_t buttons() const noexcept { return buttons_.size(); }
  /// An empty input report of the one that holds `axis`, which must be in axes().
  [[nodiscard]] HidReport place_report(std::size_t axis) const noexcept {
    return {place_forms_[axis].number, place_forms_[axis].octets};
  }
  /// An empty PID Pool report; std::nullopt: the device has none.
  [[nodiscard]] std::optional<HidReport> pool() const noexcept;

  // Feature reports: create() asks for an effect, load() is the report to read the answer into (PID
  // Block Load), and read_load() decodes it.
  [[nodiscard]] HidReport create() const noexcept;
  [[nodiscard]] HidReport load() const noexcept;
  [[nodiscard]] PidLoad read_load(std::span<const std::uint8_t> report) const noexcept;
  /// Effects that the device holds at once; 0: not reported.
  [[nodiscard]] int read_pool(std::span<const std::uint8_t> report) const noexcept;
  /// Whether the device allocates the memory of effects itself; true if it does not report that.
  [[nodiscard]] bool has_room_of_its_own(std::span<const std::uint8_t> report) const noexcept;

  // Output reports. @param block from PidLoad
  [[nodiscard]] HidReport set_effect(std::uint8_t block,
                                     std::chrono::milliseconds length) const noexcept;
  /// A condition in the units of linux/input.h, rounded so that the wall is no nearer, no stiffer
  /// and no stronger.
  [[nodiscard]] HidReport set_condition(std::uint8_t block, std::size_t axis,
                                        const ff_condition_effect& condition) const noexcept;
  [[nodiscard]] HidReport operate(std::uint8_t block, PidOperation operation) const noexcept;
  /// std::nullopt: the device has no such report; the same for control() and gain().
  [[nodiscard]] std::optional<HidReport> free(std::uint8_t block) const noexcept;
  [[nodiscard]] std::optional<HidReport> control(PidControl control) const noexcept;
  /// Full gain.
  [[nodiscard]] std::optional<HidReport> gain() const noexcept;

  /// Decodes an input report. `places` keeps what the report lacks. @return whether it holds any of
  /// it
  [[nodiscard]] bool take(std::span<const std::uint8_t> report, HidPlaces& places) const noexcept;

 private:
  using Field = std::optional<HidField>;
  struct Form {
    std::uint8_t number = 0;
    std::size_t octets = 0;  // 0: no such report
    HidKind kind = HidKind::output;
  };
  // A field that selects one usage of a list, or the bit of that usage, and the value that selects
  // it.
  struct Choice {
    HidField field;
    std::int64_t value = 0;
  };
  class Finder;

  void find_places(const Finder& finder);
  void find_effect(const Finder& finder);
  void find_condition(const Finder& finder);
  void find_operations(const Finder& finder);
  void find_rooms(const Finder& finder);
  [[nodiscard]] std::string fault_of() const;

  bool gives_forces_ = false, has_constant_forces_ = false;
  std::string fault_;
  std::array<Form, EventState::kAxes> place_forms_;
  std::array<Field, EventState::kAxes> places_;
  std::array<std::optional<EventAxis>, EventState::kAxes> ranges_;
  std::vector<HidField> buttons_;
  struct Create : Form {
    std::optional<Choice> spring;
  } create_;
  struct Load : Form {
    Field block;
    std::optional<Choice> done, full, failed;
  } load_;
  struct Pool : Form {
    Field most, is_managed;
  } pool_;
  struct SetEffect : Form {
    Field block, length, gain, has_direction;
    std::optional<Choice> spring;
  } effect_;
  struct SetCondition : Form {
    Field block, axis, at, above, below, most_above, most_below;
  } condition_;
  struct Operation : Form {
    Field block, loops;
    std::optional<Choice> start, stop;
  } operation_;
  struct Free : Form {
    Field block;
  } free_;
  struct Control : Form {
    std::optional<Choice> enable, stop_all, reset;
  } control_;
  struct Gain : Form {
    Field gain;
  } gain_;
};

}  // namespace reckon::haptics
