// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The reports of a device of the class PID (Physical Interface Devices 1.0) by which it is told
// springs, and those by which it tells where it is. Pure.
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

/// A report that begins with its number.
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

/// What a report of the device says that it is.
struct HidPlaces {
  std::array<std::int32_t, EventState::kAxes> axes{};  ///< readings
  std::array<bool, EventState::kAxes> is_known{};      ///< a report has said where the axis is
  std::uint32_t buttons = 0;                           ///< bit i: button i + 1 is down
  bool operator==(const HidPlaces&) const = default;
};

/// What became of an effect that was asked for.
struct PidLoad {
  enum class Outcome : std::uint8_t { none, done, full, failed };
  Outcome outcome = Outcome::none;
  std::uint8_t block = 0;  ///< of the effect, in all that follows
};

/// What to do with all of a device, and with an effect of it: usages of the page PID.
enum class PidControl : std::uint8_t { enable = 0x97, stop_all = 0x99, reset = 0x9A };
enum class PidOperation : std::uint8_t { start = 0x79, stop = 0x7B };

/// Made once of a descriptor; what is made of it afterwards takes no heap. Where a field is not in
/// the descriptor that nothing depends on, it is left out; the rest is needed, see fault().
class PidReports {
 public:
  explicit PidReports(const HidReports& reports);

  /// Whether it gives forces at all.
  [[nodiscard]] bool gives_forces() const noexcept { return gives_forces_; }
  [[nodiscard]] bool has_springs() const noexcept { return create_.spring.has_value(); }
  [[nodiscard]] bool has_constant_forces() const noexcept { return has_constant_forces_; }
  /// Why it cannot be told springs as walls need them, as a sentence; empty: it can.
  [[nodiscard]] const std::string& fault() const noexcept { return fault_; }
  /// X and Y of what the hand moves.
  [[nodiscard]] const std::array<std::optional<EventAxis>, EventState::kAxes>& axes()
      const noexcept {
    return ranges_;
  }
  [[nodiscard]] std::size_t buttons() const noexcept { return buttons_.size(); }
  /// The input report that has an axis, which axes() has.
  [[nodiscard]] HidReport place_report(std::size_t axis) const noexcept {
    return {place_forms_[axis].number, place_forms_[axis].octets};
  }
  /// Of the report of what it holds; nothing: it has none.
  [[nodiscard]] std::optional<HidReport> pool() const noexcept;

  // Feature reports: asks for an effect, which report then tells what became of it, and what.
  [[nodiscard]] HidReport create() const noexcept;
  [[nodiscard]] HidReport load() const noexcept;
  [[nodiscard]] PidLoad read_load(std::span<const std::uint8_t> report) const noexcept;
  /// Effects that it holds at once; 0: it does not tell.
  [[nodiscard]] int read_pool(std::span<const std::uint8_t> report) const noexcept;
  /// Whether it finds room for effects by itself; where it does not tell, it does.
  [[nodiscard]] bool has_room_of_its_own(std::span<const std::uint8_t> report) const noexcept;

  // Output reports. @param block as PidLoad tells it
  [[nodiscard]] HidReport set_effect(std::uint8_t block,
                                     std::chrono::milliseconds length) const noexcept;
  /// As linux/input.h has it, rounded so that it is no nearer, no stiffer and no stronger.
  [[nodiscard]] HidReport set_condition(std::uint8_t block, std::size_t axis,
                                        const ff_condition_effect& condition) const noexcept;
  [[nodiscard]] HidReport operate(std::uint8_t block, PidOperation operation) const noexcept;
  /// Nothing: it cannot be told that.
  [[nodiscard]] std::optional<HidReport> free(std::uint8_t block) const noexcept;
  [[nodiscard]] std::optional<HidReport> control(PidControl control) const noexcept;
  /// The full one.
  [[nodiscard]] std::optional<HidReport> gain() const noexcept;

  /// An input report; `places` keeps what it does not say. @return whether it says any
  [[nodiscard]] bool take(std::span<const std::uint8_t> report, HidPlaces& places) const noexcept;

 private:
  using Field = std::optional<HidField>;
  struct Form {
    std::uint8_t number = 0;
    std::size_t octets = 0;  // 0: there is none
    HidKind kind = HidKind::output;
  };
  // A field that says one of a list, or has a bit for each of it, and what it says for one.
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
