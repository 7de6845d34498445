// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/hid/hid_events.hpp"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "reckon/haptics/hid/hid_device.hpp"

namespace reckon::haptics {
namespace {

// HID buttons are numbered; these key codes have no meaning of their own either.
constexpr std::uint16_t kFirstButton = BTN_TRIGGER_HAPPY1;
static_assert(EventState::kMostButtons <= BTN_TRIGGER_HAPPY40 - BTN_TRIGGER_HAPPY1 + 1);

struct Opened {
  std::optional<HidDevice> device;  // std::nullopt: no force feedback, or already unplugged
  std::optional<HidPlaces> sent;    // the state last sent as events
  std::string unread;               // why its descriptor could not be parsed; empty: it was
};

// Sets bits of an answer in the caller's buffer; bits beyond its end are dropped.
class BitAnswer {
 public:
  BitAnswer(void* octets, std::size_t length)
      : octets_(static_cast<std::uint8_t*>(octets), length) {
    std::ranges::fill(octets_, std::uint8_t{0});
  }
  void set(std::size_t bit, bool is_set = true) noexcept {
    if (is_set && bit / 8 < octets_.size())
      octets_[bit / 8] = static_cast<std::uint8_t>(octets_[bit / 8] | 1U << bit % 8);
  }
  [[nodiscard]] int length() const noexcept { return static_cast<int>(octets_.size()); }

 private:
  std::span<std::uint8_t> octets_;
};

int answer_name(const std::string& name, void* to, std::size_t length) noexcept {
  if (length == 0) return 0;
  const std::size_t octets = std::min(name.size(), length - 1);
  std::memcpy(to, name.data(), octets);
  static_cast<char*>(to)[octets] = '\0';
  return static_cast<int>(octets + 1);
}

int answer_bits(const PidReports& reports, unsigned kind, void* to, std::size_t length) noexcept {
  BitAnswer bits(to, length);
  if (kind == EV_FF) {
    bits.set(FF_SPRING, reports.has_springs());
    bits.set(FF_CONSTANT, reports.has_constant_forces());
    bits.set(FF_PERIODIC, !reports.has_springs() &&
                              !reports.has_constant_forces());  // in place of all other effects
    bits.set(FF_GAIN, reports.gain().has_value());
  } else if (kind == EV_ABS) {
    bits.set(ABS_X, reports.axes()[0].has_value());
    bits.set(ABS_Y, reports.axes()[1].has_value());
  } else if (kind == EV_KEY) {
    for (std::size_t i = 0; i < reports.buttons(); ++i) bits.set(kFirstButton + i);
  }
  return bits.length();
}

int answer_axis(const HidDevice& device, std::size_t axis, void* to) noexcept {
  const auto& range = device.reports().axes();
  if (axis >= range.size() || !range[axis]) return -EINVAL;
  input_absinfo& info = *static_cast<input_absinfo*>(to);
  info = {};
  info.minimum = range[axis]->minimum;
  info.maximum = range[axis]->maximum;
  info.value = device.places().axes[axis];
  return 0;
}

int answer_keys(const HidDevice& device, void* to, std::size_t length) noexcept {
  BitAnswer bits(to, length);
  for (std::size_t i = 0; i < device.reports().buttons(); ++i)
    bits.set(kFirstButton + i, (device.places().buttons >> i & 1U) != 0);
  return bits.length();
}

int answer(HidDevice& device, unsigned long request, void* argument) noexcept {
  const std::size_t length = _IOC_SIZE(request);
  const unsigned number = _IOC_NR(request);
  if (request == EVIOCSFF) return device.upload(*static_cast<ff_effect*>(argument));
  if (request == EVIOCRMFF)
    return device.erase(static_cast<int>(reinterpret_cast<std::intptr_t>(argument)));
  if (request == EVIOCGRAB) return device.take();
  if (request == EVIOCGEFFECTS) {
    *static_cast<int*>(argument) = device.most_effects();
    return 0;
  }
  if (_IOC_DIR(request) != _IOC_READ) return -EINVAL;
  if (number == _IOC_NR(EVIOCGNAME(0))) return answer_name(device.name(), argument, length);
  if (number == _IOC_NR(EVIOCGKEY(0))) return answer_keys(device, argument, length);
  if (number >= _IOC_NR(EVIOCGABS(0)))
    return answer_axis(device, number - _IOC_NR(EVIOCGABS(0)), argument);
  const unsigned first = _IOC_NR(EVIOCGBIT(0, 0));
  if (number < first || number > first + EV_MAX) return -EINVAL;
  return answer_bits(device.reports(), number - first, argument, length);
}

// The changes as an evdev frame that SYN_REPORT ends. @return number of events
int events_between(const std::optional<HidPlaces>& before, const HidPlaces& now,
                   std::span<input_event> events) noexcept {
  std::size_t count = 0;
  const auto add = [&](std::uint16_t type, std::uint16_t code, std::int32_t value) {
    if (count == events.size()) return;
    events[count] = {};
    events[count].type = type;
    events[count].code = code;
    events[count++].value = value;
  };
  for (std::uint16_t axis = 0; axis < now.axes.size(); ++axis)
    if (!before || before->axes[axis] != now.axes[axis]) add(EV_ABS, axis, now.axes[axis]);
  const std::uint32_t changed = before ? before->buttons ^ now.buttons : ~0U;
  for (std::uint16_t i = 0; i < EventState::kMostButtons; ++i) {
    const auto code = static_cast<std::uint16_t>(kFirstButton + i);
    if ((changed >> i & 1U) != 0)
      add(EV_KEY, code, static_cast<std::int32_t>(now.buttons >> i & 1U));
  }
  add(EV_SYN, SYN_REPORT, 0);
  return static_cast<int>(count);
}

std::string why_unread(const HidSeen& seen) {
  if (seen.descriptor.empty()) return "its report descriptor cannot be read";
  return hid_reports(seen.descriptor) ? "" : "its report descriptor is malformed";
}

std::optional<PidReports> reports_of(const HidSeen& seen) {
  const auto read = hid_reports(seen.descriptor);
  if (!read) return std::nullopt;
  PidReports reports(*read);
  return reports.gives_forces() ? std::optional(std::move(reports)) : std::nullopt;
}

bool is_undriven(const HidSeen& seen) {
  return !seen.kernel_has_springs && reports_of(seen).has_value();
}

class HidEvents final : public EventCalls {
 public:
  HidEvents(std::unique_ptr<EventCalls> events, std::unique_ptr<HidCalls> devices)
      : events_(std::move(events)), devices_(std::move(devices)) {}

  std::vector<std::string> paths() override {
    std::vector<std::string> all = events_->paths();
    for (std::string& path : devices_->paths())
      if (is_undriven(devices_->look(path))) all.push_back(std::move(path));
    return all;
  }
  std::string closed_name(const std::string& path) override {
    return is_ours(path) ? devices_->look(path).name : events_->closed_name(path);
  }
  ReportIntervals report_intervals(const std::string& path) override {
    return is_ours(path) ? devices_->report_intervals(path) : events_->report_intervals(path);
  }
  std::string denied_remedy(const std::string& path) override {
    if (!is_ours(path)) return events_->denied_remedy(path);
    return "sudo reckon devices --install-rule while it is attached, then plug it in again";
  }
  int open(const std::string& path) override {
    if (!is_ours(path)) return events_->open(path);
    const int file = devices_->open(path);
    if (file < 0) return file;
    HidSeen seen = devices_->look(path);
    Opened& opened = open_[file];
    opened.unread = why_unread(seen);
    if (auto reports = reports_of(seen))
      opened.device.emplace(*devices_, file, std::move(seen.name), std::move(*reports));
    return file;
  }
  std::string fault(int file) override {
    const Opened* const opened = find(file);
    if (opened == nullptr) return events_->fault(file);
    return opened->device ? opened->device->fault() : opened->unread;
  }
  void close(int file) noexcept override {
    if (open_.erase(file) == 0) return events_->close(file);
    devices_->close(file);
  }
  bool waits_for_device(int file) const noexcept override {
    return open_.contains(file) || events_->waits_for_device(file);
  }
  int control(int file, unsigned long request, void* argument) noexcept override {
    Opened* const opened = find(file);
    if (opened == nullptr) return events_->control(file, request, argument);
    if (request == EVIOCGVERSION) return devices_->is_there(file) ? 0 : -ENODEV;
    const int result = opened->device ? answer(*opened->device, request, argument) : -ENOTTY;
    return result < 0 && !devices_->is_there(file) ? -ENODEV : result;
  }
  int read(int file, std::span<input_event> events) noexcept override {
    Opened* const opened = find(file);
    if (opened == nullptr) return events_->read(file, events);
    if (!opened->device) return -ENOTTY;
    if (const int result = opened->device->read(); result < 0) return result;
    const HidPlaces& now = opened->device->places();
    const int count = events_between(opened->sent, now, events);
    opened->sent = now;
    return count;
  }
  int write(int file, const input_event& event) noexcept override {
    Opened* const opened = find(file);
    if (opened == nullptr) return events_->write(file, event);
    if (!opened->device) return -ENOTTY;
    const int result = event.code == FF_GAIN ? opened->device->set_full_gain()
                                             : opened->device->play(event.code, event.value > 0);
    return result < 0 && !devices_->is_there(file) ? -ENODEV : result;
  }
  void wait(int file, std::chrono::microseconds longest) noexcept override {
    find(file) == nullptr ? events_->wait(file, longest) : devices_->wait(file, longest);
  }

 private:
  static bool is_ours(const std::string& path) {
    return path.substr(path.rfind('/') + 1).starts_with("hidraw");
  }
  Opened* find(int file) noexcept {
    const auto found = open_.find(file);
    return found == open_.end() ? nullptr : &found->second;
  }

  std::unique_ptr<EventCalls> events_;
  std::unique_ptr<HidCalls> devices_;
  std::map<int, Opened> open_;
};

}  // namespace

std::vector<HidSeen> undriven_devices(HidCalls& devices) {
  std::vector<HidSeen> found;
  for (const std::string& path : devices.paths())
    if (HidSeen seen = devices.look(path); is_undriven(seen)) found.push_back(std::move(seen));
  return found;
}

std::unique_ptr<EventCalls> with_hid_devices(std::unique_ptr<EventCalls> events,
                                             std::unique_ptr<HidCalls> devices) {
  return std::make_unique<HidEvents>(std::move(events), std::move(devices));
}

std::unique_ptr<EventCalls> force_feedback_calls() {
  return with_hid_devices(kernel_event_calls(), kernel_hid_calls());
}

}  // namespace reckon::haptics
