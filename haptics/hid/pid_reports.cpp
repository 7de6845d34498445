// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/hid/pid_reports.hpp"

#include <algorithm>
#include <limits>

namespace reckon::haptics {
namespace {

using Octets = std::span<const std::uint8_t>;
using std::chrono::milliseconds;

constexpr std::uint32_t kDesktop = 0x01, kButtons = 0x09, kForces = 0x0F;
constexpr std::uint32_t kX = hid_usage(kDesktop, 0x30), kY = hid_usage(kDesktop, 0x31);

// Usages of the page PID: reports, lists and their fields.
enum : std::uint32_t {
  kSetEffect = 0x21,
  kBlock = 0x22,
  kAxisNumber = 0x23,
  kEffectType = 0x25,
  kConstantForce = 0x26,
  kSpring = 0x40,
  kDuration = 0x50,
  kEffectGain = 0x52,
  kDirectionEnable = 0x56,
  kSetCondition = 0x5F,
  kMiddle = 0x60,
  kAbove = 0x61,
  kBelow = 0x62,
  kMostAbove = 0x63,
  kMostBelow = 0x64,
  kOperationReport = 0x77,
  kOperationList = 0x78,
  kLoops = 0x7C,
  kGainReport = 0x7D,
  kDeviceGain = 0x7E,
  kPoolReport = 0x7F,
  kMostAtOnce = 0x83,
  kLoadReport = 0x89,
  kLoadStatus = 0x8B,
  kLoadDone = 0x8C,
  kLoadFull = 0x8D,
  kLoadFailed = 0x8E,
  kFreeReport = 0x90,
  kControlReport = 0x95,
  kManagedPool = 0xA9,
  kCreateReport = 0xAB
};

// Scales `steps` of `of` to a field of range 0 .. `most`.
std::int64_t rounded_down(std::int64_t steps, double of, std::int64_t most) noexcept {
  const auto all = static_cast<std::int64_t>(of);
  return std::clamp<std::int64_t>(steps, 0, all) * most / all;
}

// The center of the condition in steps of the field, rounded away from the hand: a left coefficient
// means a wall below the center, a right one a wall above it.
std::int64_t middle_of(const ff_condition_effect& condition, const HidField& field) noexcept {
  const bool is_below = condition.left_coeff > 0;
  const std::int64_t center = condition.center;
  const std::int64_t most = center < 0 ? -field.least : field.most;
  const auto all = static_cast<std::int64_t>(kEffectSteps);
  const std::int64_t size = std::min(center < 0 ? -center : center, all);
  const bool is_away = is_below == (center < 0);  // from the middle of the axis
  const std::int64_t steps = (size * most + (is_away ? all - 1 : 0)) / all;
  return center < 0 ? -steps : steps;
}

// In the unit of the field, by default milliseconds; 0: outside the range of the field.
std::int64_t ticks_of(milliseconds length, const HidField& field) noexcept {
  std::int64_t ticks = length.count();
  if (field.is_seconds) {
    for (int power = -3; power > field.exponent; --power) ticks *= 10;
    for (int power = -3; power < field.exponent; ++power) ticks /= 10;
  }
  return ticks >= field.least && ticks <= field.most ? ticks : 0;
}

bool has_both_signs(const HidField& field) noexcept { return field.least < 0 && field.most > 0; }

std::optional<EventAxis> range_of(const HidField& field) noexcept {
  using Limits = std::numeric_limits<std::int32_t>;
  if (field.least < Limits::min() || field.most > Limits::max()) return std::nullopt;
  return EventAxis{static_cast<std::int32_t>(field.least), static_cast<std::int32_t>(field.most)};
}

}  // namespace

class PidReports::Finder {
 public:
  explicit Finder(const HidReports& reports) : reports_(reports) {}

  [[nodiscard]] const HidReports& reports() const noexcept { return reports_; }
  [[nodiscard]] Form form(HidKind kind, std::uint32_t number) const {
    for (const HidField& field : reports_.fields) {
      if (field.kind == kind && is_in(field, number))
        return {field.report, reports_.size(kind, field.report), kind};
    }
    return {};
  }
  [[nodiscard]] Field field(const Form& form, std::uint32_t number) const {
    for (const HidField& field : reports_.fields)
      if (is_of(field, form) && field.usage == hid_usage(kForces, number)) return field;
    return {};
  }
  [[nodiscard]] std::optional<Choice> choice(const Form& form, std::uint32_t list,
                                             std::uint32_t number) const {
    for (const HidField& field : reports_.fields) {
      if (!is_of(field, form) || !is_in(field, list)) continue;
      if (field.usage == hid_usage(kForces, number)) return Choice{field, 1};
      for (std::size_t i = 0; i < field.choices; ++i) {
        const std::int64_t value = field.least + static_cast<std::int64_t>(i);
        if (reports_.choices[field.first_choice + i] == hid_usage(kForces, number) &&
            value <= field.most)
          return Choice{field, value};
      }
    }
    return {};
  }
  [[nodiscard]] Field input(std::uint32_t usage) const {
    for (const HidField& field : reports_.fields)
      if (field.kind == HidKind::input && field.usage == usage) return field;
    return {};
  }

 private:
  [[nodiscard]] bool is_in(const HidField& field, std::uint32_t number) const noexcept {
    return reports_.is_within(field.collection, hid_usage(kForces, number));
  }
  [[nodiscard]] static bool is_of(const HidField& field, const Form& form) noexcept {
    return form.octets > 0 && field.kind == form.kind && field.report == form.number;
  }

  const HidReports& reports_;
};

PidReports::PidReports(const HidReports& reports) {
  const Finder finder(reports);
  find_places(finder);
  find_effect(finder);
  find_condition(finder);
  find_operations(finder);
  find_rooms(finder);
  gives_forces_ = effect_.octets > 0;
  if (has_springs()) fault_ = fault_of();
}

void PidReports::find_places(const Finder& finder) {
  constexpr std::array kUsages{kX, kY};
  for (std::size_t axis = 0; axis < kUsages.size(); ++axis) {
    places_[axis] = finder.input(kUsages[axis]);
    if (!places_[axis]) continue;
    ranges_[axis] = range_of(*places_[axis]);
    const std::uint8_t report = places_[axis]->report;
    place_forms_[axis] = {report, finder.reports().size(HidKind::input, report), HidKind::input};
  }
  for (const HidField& field : finder.reports().fields) {
    const bool is_button = field.kind == HidKind::input && field.usage >> 16 == kButtons;
    if (is_button && buttons_.size() < EventState::kMostButtons) buttons_.push_back(field);
  }
}

void PidReports::find_effect(const Finder& finder) {
  static_cast<Form&>(effect_) = finder.form(HidKind::output, kSetEffect);
  effect_.block = finder.field(effect_, kBlock);
  effect_.length = finder.field(effect_, kDuration);
  effect_.gain = finder.field(effect_, kEffectGain);
  effect_.has_direction = finder.field(effect_, kDirectionEnable);
  effect_.spring = finder.choice(effect_, kEffectType, kSpring);
  has_constant_forces_ = finder.choice(effect_, kEffectType, kConstantForce).has_value();
}

// A report without an axis number has one axis.
void PidReports::find_condition(const Finder& finder) {
  static_cast<Form&>(condition_) = finder.form(HidKind::output, kSetCondition);
  condition_.block = finder.field(condition_, kBlock);
  condition_.axis = finder.field(condition_, kAxisNumber);
  condition_.at = finder.field(condition_, kMiddle);
  condition_.above = finder.field(condition_, kAbove);
  condition_.below = finder.field(condition_, kBelow);
  condition_.most_above = finder.field(condition_, kMostAbove);
  condition_.most_below = finder.field(condition_, kMostBelow);
  if (!condition_.axis || condition_.axis->most < 1) ranges_[1].reset();
}

void PidReports::find_operations(const Finder& finder) {
  static_cast<Form&>(operation_) = finder.form(HidKind::output, kOperationReport);
  operation_.block = finder.field(operation_, kBlock);
  operation_.loops = finder.field(operation_, kLoops);
  operation_.start = finder.choice(operation_, kOperationList, std::uint32_t(PidOperation::start));
  operation_.stop = finder.choice(operation_, kOperationList, std::uint32_t(PidOperation::stop));
  static_cast<Form&>(control_) = finder.form(HidKind::output, kControlReport);
  const auto control = [&](PidControl what) {
    return finder.choice(control_, kControlReport, std::uint32_t(what));
  };
  control_.enable = control(PidControl::enable);
  control_.stop_all = control(PidControl::stop_all);
  control_.reset = control(PidControl::reset);
  static_cast<Form&>(gain_) = finder.form(HidKind::output, kGainReport);
  gain_.gain = finder.field(gain_, kDeviceGain);
}

void PidReports::find_rooms(const Finder& finder) {
  static_cast<Form&>(create_) = finder.form(HidKind::feature, kCreateReport);
  create_.spring = finder.choice(create_, kEffectType, kSpring);
  static_cast<Form&>(load_) = finder.form(HidKind::feature, kLoadReport);
  load_.block = finder.field(load_, kBlock);
  load_.done = finder.choice(load_, kLoadStatus, kLoadDone);
  load_.full = finder.choice(load_, kLoadStatus, kLoadFull);
  load_.failed = finder.choice(load_, kLoadStatus, kLoadFailed);
  static_cast<Form&>(pool_) = finder.form(HidKind::feature, kPoolReport);
  pool_.most = finder.field(pool_, kMostAtOnce);
  pool_.is_managed = finder.field(pool_, kManagedPool);
  static_cast<Form&>(free_) = finder.form(HidKind::output, kFreeReport);
  free_.block = finder.field(free_, kBlock);
}

std::string PidReports::fault_of() const {
  const auto lacks = [](const char* what) {
    return std::string("its reports have no ") + what + ", which walls need";
  };
  for (const Form* const form : std::initializer_list<const Form*>{
           &place_forms_[0], &place_forms_[1], &create_, &load_, &pool_, &effect_, &condition_,
           &operation_, &free_, &control_, &gain_}) {
    if (form->octets > 0 && form->number == 0) return "its reports have no report IDs";
    if (form->octets > HidReport::kMost) return "one of its reports is longer than 256 octets";
  }
  if (!load_.block || !load_.done)
    return lacks("answer to the creation of an effect (PID Block Load)");
  if (!effect_.block || !effect_.spring || !condition_.block || !operation_.block)
    return lacks("number (Effect Block Index) or type of an effect");
  if (!effect_.length || ticks_of(kEffectLength, *effect_.length) < 1)
    return lacks("length of an effect (Duration) of 60 ms");
  if (!condition_.at || !has_both_signs(*condition_.at))
    return lacks("centre of a spring (CP Offset) on both sides");
  if (!condition_.above || !condition_.below || condition_.above->most < 1 ||
      condition_.below->most < 1)
    return lacks("coefficient of each side of a spring");
  if (!condition_.most_above || !condition_.most_below || condition_.most_above->most < 1 ||
      condition_.most_below->most < 1)
    return lacks("greatest force of each side of a spring (Saturation)");
  if (!operation_.start || !operation_.stop) return lacks("start and stop of an effect");
  return {};
}

std::optional<HidReport> PidReports::pool() const noexcept {
  if (pool_.octets == 0 || pool_.octets > HidReport::kMost) return std::nullopt;
  return HidReport(pool_.number, pool_.octets);
}

HidReport PidReports::create() const noexcept {
  HidReport out(create_.number, create_.octets);
  put_number(out.span(), create_.spring->field, create_.spring->value);
  return out;
}

HidReport PidReports::load() const noexcept { return {load_.number, load_.octets}; }

PidLoad PidReports::read_load(Octets report) const noexcept {
  const auto says = [&](const std::optional<Choice>& choice) {
    return choice && number_in(report, choice->field) == choice->value;
  };
  if (report.empty() || report[0] != load_.number) return {};
  if (says(load_.full)) return {PidLoad::Outcome::full, 0};
  if (says(load_.failed)) return {PidLoad::Outcome::failed, 0};
  const auto block = number_in(report, *load_.block);
  if (!says(load_.done) || !block || *block < 1 || *block > 255) return {};
  return {PidLoad::Outcome::done, static_cast<std::uint8_t>(*block)};
}

int PidReports::read_pool(Octets report) const noexcept {
  if (!pool_.most || report.empty() || report[0] != pool_.number) return 0;
  return static_cast<int>(
      std::clamp<std::int64_t>(number_in(report, *pool_.most).value_or(0), 0, 255));
}

bool PidReports::has_room_of_its_own(Octets report) const noexcept {
  if (!pool_.is_managed || report.empty() || report[0] != pool_.number) return true;
  return number_in(report, *pool_.is_managed) != 0;
}

HidReport PidReports::set_effect(std::uint8_t block, milliseconds length) const noexcept {
  HidReport out(effect_.number, effect_.octets);
  put_number(out.span(), *effect_.block, block);
  put_number(out.span(), effect_.spring->field, effect_.spring->value);
  put_number(out.span(), *effect_.length, ticks_of(length, *effect_.length));
  if (effect_.gain) put_number(out.span(), *effect_.gain, effect_.gain->most);
  if (effect_.has_direction) put_number(out.span(), *effect_.has_direction, 1);
  return out;
}

HidReport PidReports::set_condition(std::uint8_t block, std::size_t axis,
                                    const ff_condition_effect& condition) const noexcept {
  HidReport out(condition_.number, condition_.octets);
  const auto put = [&](const Field& field, std::int64_t number) {
    put_number(out.span(), *field, number);
  };
  put(condition_.block, block);
  if (condition_.axis) put(condition_.axis, static_cast<std::int64_t>(axis));
  put(condition_.at, middle_of(condition, *condition_.at));
  put(condition_.above, rounded_down(condition.right_coeff, kEffectSteps, condition_.above->most));
  put(condition_.below, rounded_down(condition.left_coeff, kEffectSteps, condition_.below->most));
  put(condition_.most_above,
      rounded_down(condition.right_saturation, kEffectLevels, condition_.most_above->most));
  put(condition_.most_below,
      rounded_down(condition.left_saturation, kEffectLevels, condition_.most_below->most));
  return out;
}

HidReport PidReports::operate(std::uint8_t block, PidOperation operation) const noexcept {
  const Choice& choice = operation == PidOperation::start ? *operation_.start : *operation_.stop;
  HidReport out(operation_.number, operation_.octets);
  put_number(out.span(), *operation_.block, block);
  put_number(out.span(), choice.field, choice.value);
  if (operation_.loops) put_number(out.span(), *operation_.loops, 1);
  return out;
}

std::optional<HidReport> PidReports::free(std::uint8_t block) const noexcept {
  if (!free_.block) return std::nullopt;
  HidReport out(free_.number, free_.octets);
  put_number(out.span(), *free_.block, block);
  return out;
}

std::optional<HidReport> PidReports::control(PidControl control) const noexcept {
  const std::optional<Choice>& choice = control == PidControl::enable  ? control_.enable
                                        : control == PidControl::reset ? control_.reset
                                                                       : control_.stop_all;
  if (!choice) return std::nullopt;
  HidReport out(control_.number, control_.octets);
  put_number(out.span(), choice->field, choice->value);
  return out;
}

std::optional<HidReport> PidReports::gain() const noexcept {
  if (!gain_.gain) return std::nullopt;
  HidReport out(gain_.number, gain_.octets);
  put_number(out.span(), *gain_.gain, gain_.gain->most);
  return out;
}

bool PidReports::take(Octets report, HidPlaces& places) const noexcept {
  bool says_any = false;
  const auto read = [&](const HidField& field) -> std::optional<std::int64_t> {
    if (report.empty() || field.report != report[0]) return std::nullopt;
    const auto number = number_in(report, field);
    says_any = says_any || number.has_value();
    return number;
  };
  for (std::size_t axis = 0; axis < places_.size(); ++axis) {
    if (!places_[axis] || !ranges_[axis]) continue;
    const auto number = read(*places_[axis]);
    if (!number) continue;
    places.axes[axis] = static_cast<std::int32_t>(
        std::clamp<std::int64_t>(*number, ranges_[axis]->minimum, ranges_[axis]->maximum));
    places.is_known[axis] = true;
  }
  for (std::size_t i = 0; i < buttons_.size(); ++i) {
    const std::uint32_t bit = 1U << i;
    if (const auto number = read(buttons_[i]))
      places.buttons = *number != 0 ? places.buttons | bit : places.buttons & ~bit;
  }
  return says_any;
}

}  // namespace reckon::haptics
