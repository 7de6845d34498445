// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/udp_readiness.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <system_error>
#include <utility>

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

// Tags that are no sockets; the number of a socket is below them.
constexpr std::uint32_t kWakeTag = 0xffffffffu, kHostTag = 0xfffffffeu, kFirstTag = 0xfffffffdu;

}  // namespace

UdpReadiness::UdpReadiness(const Clock& clock) : clock_(clock) {
  if (!watch(epoll_, wake_.get(), kWakeTag) || !watch(epoll_, first_epoll_.get(), kFirstTag)) {
    throw std::system_error(errno, std::generic_category(), "epoll_ctl");
  }
  has_host_notices_ = host_.descriptor() >= 0 && watch(epoll_, host_.descriptor(), kHostTag);
}

bool UdpReadiness::watch(const Descriptor& where, int descriptor, std::uint32_t tag) noexcept {
  epoll_event event{};
  event.events = EPOLLIN;
  event.data.u32 = tag;
  return epoll_ctl(where.get(), EPOLL_CTL_ADD, descriptor, &event) == 0;
}

bool UdpReadiness::add(int socket, std::uint32_t number, bool first) noexcept {
  return watch(first ? first_epoll_ : epoll_, socket, number);
}

void UdpReadiness::poll(nanoseconds timeout) noexcept {
  const nanoseconds bounded = std::max(timeout, nanoseconds{0});
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(bounded);
  const timespec limit{seconds.count(), (bounded - seconds).count()};
  const nanoseconds begun = clock_.now();
  const int ready =
      epoll_pwait2(epoll_.get(), events_.data(), static_cast<int>(events_.size()), &limit, nullptr);
  if (ready < 0) woken_ = true;
  crowded_ = ready == static_cast<int>(events_.size());
  next_event_ = 0;
  first_ready_ = false;
  // The wake-up stays unread here: wait() takes it, and receive() leaves it to the next wait(). If
  // there is none, nothing needs to be read, which saves the system call.
  const auto is_no_socket = [this](const epoll_event& event) {
    if (event.data.u32 == kWakeTag) wake_waits_ = true;
    if (event.data.u32 == kHostTag) host_changed_ = host_.take_changes() || host_changed_;
    if (event.data.u32 == kFirstTag) first_ready_ = true;
    return event.data.u32 >= kFirstTag;
  };
  const auto end =
      std::remove_if(events_.begin(), events_.begin() + std::max(ready, 0), is_no_socket);
  event_count_ = static_cast<std::size_t>(end - events_.begin());
  if (ready >= 0 && event_count_ == 0 && !first_ready_) all_empty_ = begun;
}

std::size_t UdpReadiness::find_first(std::span<std::uint32_t> out) noexcept {
  std::array<epoll_event, kMostFirst> ready;
  const int most = static_cast<int>(std::min(out.size(), ready.size()));
  const int count = epoll_wait(first_epoll_.get(), ready.data(), most, 0);
  for (int i = 0; i < count; ++i) {
    const auto place = static_cast<std::size_t>(i);
    out[place] = ready[place].data.u32;
  }
  return static_cast<std::size_t>(std::max(count, 0));
}

void UdpReadiness::wake() noexcept {
  const std::uint64_t one = 1;
  // It can only fail if the count is full, and then the reader is already being woken.
  [[maybe_unused]] const ssize_t written = ::write(wake_.get(), &one, sizeof one);
}

bool UdpReadiness::take_wake() noexcept {
  const bool by_signal = std::exchange(woken_, false);
  if (!std::exchange(wake_waits_, false)) return by_signal;
  std::uint64_t times = 0;
  return ::read(wake_.get(), &times, sizeof times) == sizeof times || by_signal;
}

}  // namespace reckon::peer
