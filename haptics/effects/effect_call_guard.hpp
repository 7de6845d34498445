// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Guards the calls of custom effects in the servo: measures their time and bounds their forces.
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <chrono>
#include <concepts>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

namespace reckon::haptics {

/// Findings about a custom effect on one object or in one region. Servo threads write it, any
/// thread reads it.
struct GuardReport {
  std::string key;                           ///< key of the effect
  std::string object;                        ///< object or region for which it is declared
  std::atomic<std::uint64_t> not_finite{0};  ///< results that were not numbers, and count as zero
  std::atomic<std::uint64_t> too_strong{0};  ///< forces above CallGuard::kMostForce, limited to it
  std::atomic<bool> not_booked{false};       ///< its spring or potential is held, not booked
  std::atomic<bool> switched_off{false};     ///< it took too long
  std::atomic<std::int64_t> slowest{0};      ///< longest call [ns]
};

/// Times the calls of one copy of an effect. If kSlowCalls among kCalls take longer than kSlow, the
/// effect is switched off permanently. One thread, except for the report, which copies share.
class CallGuard {
 public:
  static constexpr double kMostForce = 100.0;      ///< [N]
  static constexpr std::int64_t kSlow = 250'000;   ///< [ns]
  static constexpr std::uint32_t kSlowCalls = 10;  ///< a busy host may interrupt a few
  static constexpr std::uint32_t kCalls = 1000;

  CallGuard(const std::string& key, const std::string& object)
      : report_(std::make_shared<GuardReport>()) {
    report_->key = key;
    report_->object = object;
  }

  /// A copy keeps the findings about the code, and restarts the counts.
  CallGuard(const CallGuard& other) : report_(other.report_), off_(other.off_) {}
  CallGuard(CallGuard&& other) noexcept = default;
  /// Takes the report; the findings about the code stay.
  CallGuard& operator=(const CallGuard& other) noexcept {
    report_ = other.report_;
    return *this;
  }
  CallGuard& operator=(CallGuard&& other) noexcept = default;
  ~CallGuard() = default;

  [[nodiscard]] GuardReport& report() const noexcept { return *report_; }
  [[nodiscard]] const std::shared_ptr<GuardReport>& shared_report() const noexcept {
    return report_;
  }

  /// Checked before an effect's results take effect, so that its force and its energy stay
  /// consistent.
  [[nodiscard]] bool is_off() noexcept {
    if (off_ || slow_ < kSlowCalls) return off_;
    report_->switched_off.store(true, std::memory_order_relaxed);
    return off_ = true;
  }
  [[nodiscard]] bool was_off() const noexcept { return off_; }

  /// The result of `call`, timed.
  template <class Call>
  auto timed(Call&& call) noexcept {
    const Timing timing(*this);
    return std::forward<Call>(call)();
  }

  /// Zero for a force that is not a number, and at most kMostForce; both cases are counted.
  [[nodiscard]] Eigen::Vector3d bounded(const Eigen::Vector3d& force) const noexcept {
    if (!force.allFinite()) {
      report_->not_finite.fetch_add(1, std::memory_order_relaxed);
      return Eigen::Vector3d::Zero();
    }
    if (!(force.stableNorm() > kMostForce)) return force;
    report_->too_strong.fetch_add(1, std::memory_order_relaxed);
    return kMostForce * force.stableNormalized();
  }

 private:
  // The only code of the servo that reads a clock.
  class Timing {
   public:
    explicit Timing(CallGuard& guard) noexcept
        : guard_(guard), begun_(std::chrono::steady_clock::now()) {}
    Timing(const Timing&) = delete;
    Timing& operator=(const Timing&) = delete;
    ~Timing() {
      const std::int64_t took =
          std::chrono::nanoseconds(std::chrono::steady_clock::now() - begun_).count();
      std::atomic<std::int64_t>& slowest = guard_.report_->slowest;
      if (took > slowest.load(std::memory_order_relaxed))
        slowest.store(took, std::memory_order_relaxed);
      if (++guard_.calls_ > kCalls) guard_.calls_ = guard_.slow_ = 0;
      if (took > kSlow) ++guard_.slow_;
    }

   private:
    CallGuard& guard_;
    std::chrono::steady_clock::time_point begun_;
  };

  std::shared_ptr<GuardReport> report_;
  bool off_ = false;
  std::uint32_t calls_ = 0, slow_ = 0;
};

/// A guarded custom effect.
template <class Effect>
concept IsGuarded = requires(const Effect& effect) {
  { effect.report() } -> std::convertible_to<std::shared_ptr<const GuardReport>>;
};

}  // namespace reckon::haptics
