// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/unplugs/real_unplugs.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <thread>
#include <utility>
#include <vector>

#include "reckon/haptics/falcon/falcon_driver.hpp"
#include "reckon/haptics/polhem/polhem_driver.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/drivers/serial.hpp"
#include "reckon/peer/threads/real_device.hpp"
#include "reckon/tests/haptics/support/falcon_model.hpp"
#include "reckon/tests/haptics/support/far_end.hpp"
#include "reckon/tests/haptics/support/polhem_model.hpp"
#include "reckon/tests/haptics/support/serial_board.hpp"
#include "reckon/tests/haptics/support/usb_shim.hpp"
#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::fuzz::unplugs {
namespace {

using Eigen::Vector3d;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr nanoseconds kLongest = seconds(30);  // longest wait, on a busy host
constexpr nanoseconds kZeroWithin = milliseconds(10);
const Vector3d kForce(0.2, 0.1, 0.3);

/// The device in the rounds; the servo's thread calls it.
class Plug {
 public:
  virtual ~Plug() = default;
  virtual haptics::HapticDevice& device() = 0;
  virtual std::vector<std::string> take_notices() = 0;
  virtual void pull() = 0;
  virtual void plug() = 0;
  virtual bool shows_force() = 0;
  virtual std::uint64_t commands() = 0;
  /// A millisecond of work beside the thread.
  virtual void tend(const std::vector<std::string>& notices) = 0;
};

class Rounds {
 public:
  Rounds(const peer::Clock& clock, Plug& plug, unsigned seed)
      : clock_(clock), plug_(plug), random_(seed) {}

  RealOutcome run(unsigned rounds) {
    while (outcome_.rounds < rounds && outcome_.problem.empty()) {
      round();
      if (outcome_.problem.empty()) ++outcome_.rounds;
    }
    return std::move(outcome_);
  }

 private:
  void fail(const std::string& what) {
    if (outcome_.problem.empty())
      outcome_.problem = fmt::format("round {}: {}", outcome_.rounds + 1, what);
  }

  [[nodiscard]] nanoseconds below(unsigned microseconds_most) {
    return microseconds(random_() % microseconds_most);
  }

  // A servo step.
  void step() {
    is_read_ = plug_.device().read(clock_.now()).ok;
    plug_.device().write(kForce, clock_.now());
    const std::vector<std::string> notices = plug_.take_notices();
    for (const std::string& notice : notices)
      unplugs_told_ += notice.find("was unplugged: ") != std::string::npos ? 1 : 0;
    plug_.tend(notices);
    std::this_thread::sleep_for(milliseconds(1));
  }

  bool wait_for(const std::function<bool()>& what) {
    const nanoseconds end = clock_.now() + kLongest;
    while (!what()) {
      if (clock_.now() > end) return false;
      step();
    }
    return true;
  }

  void round() {
    if (!wait_for([&] { return is_read_ && plug_.shows_force(); }))
      return fail("it is not taken up again");
    const nanoseconds pulls_at = clock_.now() + below(20'000);
    wait_for([&] { return clock_.now() >= pulls_at; });
    std::this_thread::sleep_for(below(1'000));

    unplugs_told_ = 0;
    plug_.pull();
    const nanoseconds pulled_at = clock_.now();
    const std::uint64_t commands = plug_.commands();
    step();
    if (!wait_for([&] { return !is_read_; })) return fail("it is read though it is not there");
    const nanoseconds took = clock_.now() - pulled_at;
    outcome_.longest = std::max(outcome_.longest, took);
    if (took > kZeroWithin) ++outcome_.late;
    const nanoseconds plugged_at = clock_.now() + below(50'000);
    wait_for([&] { return clock_.now() >= plugged_at; });
    if (plug_.commands() != commands) fail("it was told something when it was not there");
    if (!wait_for([&] { return unplugs_told_ > 0; })) fail("nothing was said");
    if (unplugs_told_ > 1) fail(fmt::format("it was said {} times", unplugs_told_));
    plug_.plug();
  }

  const peer::Clock& clock_;
  Plug& plug_;
  std::mt19937 random_;
  RealOutcome outcome_;
  bool is_read_ = false;
  unsigned unplugs_told_ = 0;
};

template <class Model>
class UsbPlug final : public Plug {
 public:
  template <class Options>
  UsbPlug(const peer::Clock& clock, const Options& options, const Vector3d& place,
          std::unique_ptr<haptics::UsbDriver> driver, const UsbSite* site)
      : site_(site),
        model_(options, [place](double) { return place; }),
        shim_(model_, [&clock, begin = clock.now()] { return clock.now() - begin; }) {
    model_.lead(place);
    haptics::UsbLoopOptions finding;
    if (site_ != nullptr) {
      shim_.be_at(site_->node);
      site_->add(model_.descriptors());
    } else {
      finding.discover = false;
      finding.open = [this](libusb_context* context) {
        haptics::UsbOpening opening{shim_.open(context), {}};
        if (opening.handle == nullptr) opening.problem = "none is attached";
        return opening;
      };
    }
    const haptics::DeviceLimits limits = haptics::usb_limits(driver->facts(), {});
    real_ = peer::usb_device(clock, limits, std::move(driver), std::move(finding));
  }

  haptics::HapticDevice& device() override { return real_->device(); }
  std::vector<std::string> take_notices() override { return real_->take_notices(); }
  void pull() override {
    shim_.unplug();
    shim_.with_model([&] { model_.forget_line(); });
    if (site_ != nullptr) site_->remove();
  }
  void plug() override {
    shim_.plug();
    if (site_ != nullptr) site_->add(model_.descriptors());
  }
  bool shows_force() override {
    return shim_.with_model([&] { return model_.motors() != decltype(model_.motors()){}; });
  }
  std::uint64_t commands() override {
    return shim_.with_model([&] { return model_.commands(); });
  }
  void tend(const std::vector<std::string>& notices) override {
    if constexpr (std::is_same_v<Model, test::PolhemModel>) {
      for (const std::string& notice : notices) {
        if (notice.find("not homed") != std::string::npos)
          shim_.with_model([&] { model_.press(); });
      }
    }
  }

 private:
  const UsbSite* site_;
  Model model_;
  test::UsbShim shim_;
  std::unique_ptr<peer::RealDevice> real_;
};

class BoardPlug final : public Plug {
 public:
  explicit BoardPlug(const peer::Clock& clock)
      : clock_(clock),
        begin_(clock.now()),
        board_({}, [](double) { return Vector3d(0.01, 0.02, 0.03); }) {
    haptics::UsbSettings settings;
    settings.max_force = 5.0;
    settings.resolution = 20e-6;
    plug();
    real_ = peer::serial_device(clock, haptics::usb_limits(haptics::serial_facts(), settings),
                                {port(), haptics::SerialPlace::kBaud});
  }

  haptics::HapticDevice& device() override { return real_->device(); }
  std::vector<std::string> take_notices() override { return real_->take_notices(); }
  void pull() override {
    far_.reset();
    static_cast<void>(std::remove(port().c_str()));
  }
  void plug() override {
    board_.forget();
    far_.emplace();
    if (::symlink(far_->name().c_str(), port().c_str()) != 0) std::abort();
  }
  bool shows_force() override { return !board_.force().isZero(0); }
  std::uint64_t commands() override { return 0; }  // its line is gone
  void tend(const std::vector<std::string>&) override {
    if (far_) {
      for (const std::uint8_t octet : far_->fetch()) board_.take(octet);
    }
    while (board_.now() < clock_.now() - begin_) {
      for (const std::vector<std::uint8_t>& frame : board_.pass()) {
        // A full line loses frames, as a real one does.
        if (far_ && ::write(far_->descriptor(), frame.data(), frame.size()) < 0) continue;
      }
    }
  }

 private:
  [[nodiscard]] std::string port() const { return folder_.file("board"); }

  const peer::Clock& clock_;
  nanoseconds begin_;
  test::ScratchFolder folder_;
  test::SerialBoard board_;
  std::optional<test::FarEnd> far_;
  std::unique_ptr<peer::RealDevice> real_;
};

template <class Model, class Options>
RealOutcome unplugged(const Options& options, const Vector3d& place,
                      std::unique_ptr<haptics::UsbDriver> driver, unsigned rounds, unsigned seed,
                      const UsbSite* site) {
  const peer::SteadyClock clock;
  UsbPlug<Model> plug(clock, options, place, std::move(driver), site);
  return Rounds(clock, plug, seed).run(rounds);
}

}  // namespace

RealOutcome unplug_usb(DeviceKind device, unsigned rounds, unsigned seed, const UsbSite* site) {
  if (device == DeviceKind::polhem) {
    return unplugged<test::PolhemModel>(test::PolhemModelOptions{}, test::PolhemModel::start(),
                                        std::make_unique<haptics::PolhemDriver>(), rounds, seed,
                                        site);
  }
  return unplugged<test::FalconModel>(
      test::FalconModelOptions{}, {0, 0, 0.01},
      std::make_unique<haptics::FalconDriver>(haptics::FalconFirmware{}), rounds, seed, site);
}

RealOutcome unplug_board(unsigned rounds, unsigned seed) {
  const peer::SteadyClock clock;
  BoardPlug plug(clock);
  return Rounds(clock, plug, seed).run(rounds);
}

}  // namespace reckon::fuzz::unplugs
