// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/plugin/plugin_device.hpp"

#include <dlfcn.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace reckon::haptics {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using std::chrono::nanoseconds;
using std::chrono::steady_clock;

constexpr const char* kTable = "reckon_device_driver_table";
constexpr double kUnit = 1e-6;  // tolerance of a quaternion's length

Vector3d vector(const double (&v)[3]) noexcept { return {v[0], v[1], v[2]}; }
Quaterniond quaternion(const double (&q)[4]) noexcept { return {q[0], q[1], q[2], q[3]}; }
bool is_turn(const Quaterniond& q) noexcept { return std::abs(q.norm() - 1.0) < kUnit; }

DeviceLimits limits_of(const reckon_device_limits& from) {
  DeviceLimits limits;
  limits.axes = from.axes;
  limits.delay_samples = from.delay_samples;
  limits.max_force = from.max_force;
  limits.max_stiffness = from.max_stiffness;
  limits.damping = from.damping;
  limits.max_speed = from.max_speed;
  limits.resolution = from.resolution;
  limits.workspace_min = vector(from.workspace_min);
  limits.workspace_max = vector(from.workspace_max);
  limits.max_torque = from.max_torque;
  limits.turn_damping = from.turn_damping;
  limits.turn_resolution = from.turn_resolution;
  return limits;
}

/// The rule that the limits break, with its bounds; empty: none.
std::string fault_of(const DeviceLimits& limits) {
  constexpr int kMostDelay = 1000;
  const auto is_within = [](double value, double least, double most) {
    return value >= least && value <= most;
  };
  const bool turns = limits.axes == 6;
  const std::array<std::pair<bool, std::string_view>, 11> rules{{
      {limits.axes == 3 || turns, "axes must be 3 or 6"},
      {limits.delay_samples >= 0 && limits.delay_samples <= kMostDelay,
       "delay_samples must be 0 to 1000"},
      {is_within(limits.max_force, 1e-3, 1e4), "max_force must be 0.001 to 10000 N"},
      {is_within(limits.max_stiffness, 0, 1e7), "max_stiffness must be 0 to 1e7 N/m"},
      {is_within(limits.damping, 0, 1e4), "damping must be 0 to 10000 N s/m"},
      {is_within(limits.max_speed, 1e-3, 1e3), "max_speed must be 0.001 to 1000 m/s"},
      {is_within(limits.resolution, 0, 0.1), "resolution must be 0 to 0.1 m"},
      {((limits.workspace_max - limits.workspace_min).array() > 0).all() &&
           (limits.workspace_max - limits.workspace_min).allFinite(),
       "workspace_min must be below workspace_max"},
      {!turns || is_within(limits.max_torque, 1e-6, 1e4), "max_torque must be 1e-6 to 10000 N m"},
      {!turns || is_within(limits.turn_damping, 1e-9, 1e4),
       "turn_damping must be 1e-9 to 10000 N m s/rad"},
      {!turns || is_within(limits.turn_resolution, 0, 1), "turn_resolution must be 0 to 1 rad"},
  }};
  const auto broken = std::ranges::find(rules, false, &std::pair<bool, std::string_view>::first);
  return broken == rules.end() ? std::string() : std::string(broken->second);
}

}  // namespace

struct PluginDevice::Library {
  explicit Library(const std::filesystem::path& file)
      : handle(dlopen(std::filesystem::absolute(file).c_str(), RTLD_NOW | RTLD_LOCAL)) {
    if (handle == nullptr) throw std::runtime_error(std::string(dlerror()));
  }
  ~Library() { dlclose(handle); }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;

  void* handle;
};

PluginDevice::PluginDevice(const std::filesystem::path& file, const std::string& options) {
  const auto refuse = [&](const std::string& why) {
    throw std::runtime_error(file.string() + ": " + why);
  };
  if (std::error_code none; !std::filesystem::is_regular_file(file, none))
    refuse("no such file: give the driver's shared library");
  library_ = std::make_unique<Library>(file);
  using Table = const reckon_device_driver*();
  auto* const table = reinterpret_cast<Table*>(dlsym(library_->handle, kTable));
  if (table == nullptr)
    refuse(std::string("has no function ") + kTable +
           ", so it is not a driver: see device_plugin.h");
  driver_ = table();
  if (driver_ == nullptr) refuse("its function table is null");
  if (driver_->abi != RECKON_DEVICE_ABI || driver_->size != sizeof(reckon_device_driver)) {
    refuse("was built for version " + std::to_string(driver_->abi) + " of device_plugin.h (" +
           std::to_string(driver_->size) + " octets), and this program has version " +
           std::to_string(RECKON_DEVICE_ABI) + " (" + std::to_string(sizeof(reckon_device_driver)) +
           " octets): rebuild it");
  }
  if (driver_->name == nullptr || driver_->open == nullptr || driver_->limits == nullptr ||
      driver_->read == nullptr || driver_->write == nullptr || driver_->close == nullptr)
    refuse("lacks a function or its name: open, limits, read, write, close and name are required");
  name_ = driver_->name;
  std::array<char, 256> error{};
  device_ = driver_->open(options.c_str(), error.data(), error.size() - 1);
  if (device_ == nullptr) {
    const std::string_view said(error.data());
    refuse(said.empty() ? "its open function fails without a message" : std::string(said));
  }
  reckon_device_limits limits{};
  driver_->limits(device_, &limits);
  limits_ = limits_of(limits);
  if (const std::string fault = fault_of(limits_); !fault.empty()) {
    driver_->close(device_);
    device_ = nullptr;
    refuse("its device states invalid limits: " + fault);
  }
}

PluginDevice::~PluginDevice() {
  if (device_ != nullptr) driver_->close(device_);
}

void PluginDevice::note_time(steady_clock::time_point begun) noexcept {
  const std::int64_t took = nanoseconds(steady_clock::now() - begun).count();
  calls_.fetch_add(1, std::memory_order_relaxed);
  if (took > nanoseconds(kSlow).count()) slow_.fetch_add(1, std::memory_order_relaxed);
  if (took > slowest_.load(std::memory_order_relaxed))
    slowest_.store(took, std::memory_order_relaxed);
}

DeviceSample PluginDevice::read(nanoseconds now) noexcept {
  const steady_clock::time_point begun = steady_clock::now();
  reckon_device_reading reading{};
  const bool is_read = driver_->read(device_, now.count(), &reading) == 0;
  note_time(begun);
  const auto has = [&](std::uint32_t flag) { return (reading.flags & flag) != 0; };
  DeviceSample sample;
  sample.ok = is_read;
  if (!is_read) return sample;
  sample.position = vector(reading.position);
  sample.velocity = vector(reading.velocity);
  sample.has_velocity = has(RECKON_DEVICE_HAS_VELOCITY);
  sample.enabled = !has(RECKON_DEVICE_DISABLED);
  sample.watchdog = has(RECKON_DEVICE_LET_GO);
  sample.buttons = reading.buttons;
  sample.ok = sample.position.allFinite() && (!sample.has_velocity || sample.velocity.allFinite());
  if (limits_.axes == 6) {
    sample.turn = {quaternion(reading.orientation), vector(reading.turn_rate)};
    sample.ok = sample.ok && is_turn(sample.turn->orientation);
  }
  if (sample.watchdog && has(RECKON_DEVICE_RELEASED_AT)) {
    sample.released_at = vector(reading.released_at);
    if (limits_.axes == 6) sample.released_turned = quaternion(reading.released_orientation);
  }
  if (!sample.ok) impossible_.fetch_add(1, std::memory_order_relaxed);
  return sample;
}

void PluginDevice::write_wrench(const Vector3d& force, const Vector3d& torque,
                                nanoseconds now) noexcept {
  const bool is_good = force.allFinite() && torque.allFinite();
  const Vector3d f = is_good ? force : Vector3d(0, 0, 0), t = is_good ? torque : Vector3d(0, 0, 0);
  const steady_clock::time_point begun = steady_clock::now();
  driver_->write(device_, now.count(), f.data(), t.data());
  note_time(begun);
}

std::vector<std::string> PluginDevice::take_notices() {
  std::vector<std::string> said;
  const std::uint64_t calls = calls_.load(std::memory_order_relaxed);
  const std::uint64_t slow = slow_.load(std::memory_order_relaxed);
  if (!told_slow_ && slow >= 10 && 100 * slow >= calls) {
    told_slow_ = true;
    said.push_back(name_ + ": its driver delayed the servo in " + std::to_string(slow) + " of " +
                   std::to_string(calls) + " calls, up to " +
                   std::to_string(slowest_.load(std::memory_order_relaxed) / 1000) +
                   " us; it needs its own thread, see device_plugin.h");
  }
  const std::uint64_t impossible = impossible_.load(std::memory_order_relaxed);
  if (impossible > 0 && told_impossible_ == 0) {
    told_impossible_ = impossible;
    said.push_back(name_ +
                   ": its driver returns invalid readings (a number that is not finite, or an "
                   "orientation that is not a unit quaternion); they count as failed");
  }
  return said;
}

}  // namespace reckon::haptics
