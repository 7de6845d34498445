// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/haptics/support/usbip_device.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <linux/usb/ch9.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

namespace reckon::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr std::size_t kWords = 12;  // of a USB/IP header
constexpr std::uint32_t kSubmit = 1, kUnlink = 2, kSubmitted = 3, kUnlinked = 4;
constexpr unsigned kFullSpeed = 2;

}  // namespace

UsbipDevice::UsbipDevice(UsbipModel& model, nanoseconds frame)
    : model_(model), frame_(frame), thread_([this] { serve(); }) {}

UsbipDevice::~UsbipDevice() {
  ends_ = true;
  thread_.join();
  unplug();
}

nanoseconds UsbipDevice::now() { return std::chrono::steady_clock::now().time_since_epoch(); }

void UsbipDevice::plug_in() {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw std::runtime_error("no sockets");
  const std::string order = "0 " + std::to_string(ends[0]) + " 65538 " + std::to_string(kFullSpeed);
  const int attach = ::open((std::string(kBus) + "/attach").c_str(), O_WRONLY | O_CLOEXEC);
  bool is_taken = false;
  for (int tries = 0; tries < 200 && attach >= 0 && !is_taken; ++tries) {
    is_taken = ::write(attach, order.data(), order.size()) >= 0;  // a write is an order
    if (!is_taken) std::this_thread::sleep_for(milliseconds(20));
  }
  ::close(attach);
  ::close(ends[0]);
  if (!is_taken) {
    ::close(ends[1]);
    throw std::runtime_error("vhci_hcd takes no device");
  }
  const std::lock_guard lock(having_);
  socket_ = ends[1];
}

void UsbipDevice::unplug() {
  const std::lock_guard lock(having_);
  model_.lose_power();
  in_.clear();
  out_.clear();
  if (socket_ >= 0) ::close(std::exchange(socket_, -1));
}

void UsbipDevice::serve() {
  nanoseconds frame = now();  // that is over
  while (!ends_) {
    int socket = -1;
    {
      const std::lock_guard lock(having_);
      socket = socket_;
    }
    pollfd one{socket, POLLIN, 0};
    const nanoseconds left = std::max(frame + frame_ - now(), nanoseconds(0));
    const timespec longest{0, left.count()};
    ::ppoll(&one, 1, &longest, nullptr);
    const std::lock_guard lock(having_);
    model_.run_until(now());
    if (socket != socket_) continue;
    if ((one.revents & POLLIN) != 0 && !take_request()) ::close(std::exchange(socket_, -1));
    if (now() < frame + frame_) continue;
    frame = std::max(frame + frame_, now() - frame_);
    move_transfers();
  }
}

void UsbipDevice::move_transfers() {
  if (!out_.empty() && model_.take(out_.front().data)) {
    answer(out_.front(), 0, {});
    out_.pop_front();
  }
  if (in_.empty()) return;
  if (const auto octets = model_.give()) {
    answer(in_.front(), 0, *octets);
    in_.pop_front();
  }
}

bool UsbipDevice::receive(std::span<std::uint8_t> into) {
  while (!into.empty()) {
    const auto octets = ::recv(socket_, into.data(), into.size(), 0);
    if (octets < 0 && errno == EINTR) continue;
    if (octets <= 0) return false;
    into = into.subspan(static_cast<std::size_t>(octets));
  }
  return true;
}

// Numbers are in network byte order; the setup packet is as on the bus.
bool UsbipDevice::take_request() {
  std::array<std::uint8_t, 4 * kWords> octets{};
  if (!receive(octets)) return false;
  std::array<std::uint32_t, kWords> head{};
  std::memcpy(head.data(), octets.data(), octets.size());
  Request request;
  std::memcpy(request.setup.data(), &octets[40], request.setup.size());
  for (std::uint32_t& word : head) word = ntohl(word);
  request.number = head[1];
  if (head[0] == kUnlink) {
    cancel(head[1], head[5]);
    return true;
  }
  if (head[0] != kSubmit) return false;
  request.is_in = head[3] == 1;
  request.endpoint = head[4];
  request.length = head[6];
  if (!request.is_in) {
    request.data.resize(request.length);
    if (!receive(request.data)) return false;
  }
  if (request.endpoint == 0) {
    control(request);
  } else {
    (request.is_in ? in_ : out_).push_back(std::move(request));
  }
  return true;
}

void UsbipDevice::cancel(std::uint32_t number, std::uint32_t victim) {
  const auto is_victim = [&](const Request& one) { return one.number == victim; };
  const std::size_t out = std::erase_if(out_, is_victim);
  const std::size_t erased = std::erase_if(in_, is_victim) + out;
  if (out > 0) model_.call_off();
  std::array<std::uint32_t, kWords> head{kUnlinked, number};
  head[5] = erased > 0 ? static_cast<std::uint32_t>(-ECONNRESET) : 0;
  send(head, {});
}

void UsbipDevice::answer(const Request& request, int status, std::span<const std::uint8_t> data) {
  data = data.first(std::min<std::size_t>(data.size(), request.length));
  std::array<std::uint32_t, kWords> head{kSubmitted, request.number};
  head[5] = static_cast<std::uint32_t>(status);
  if (status == 0)
    head[6] = request.is_in ? static_cast<std::uint32_t>(data.size()) : request.length;
  send(head, data);
}

void UsbipDevice::send(std::span<const std::uint32_t> head, std::span<const std::uint8_t> data) {
  std::vector<std::uint8_t> octets(4 * kWords);
  for (std::size_t i = 0; i < kWords; ++i) {
    const std::uint32_t word = htonl(head[i]);
    std::memcpy(&octets[4 * i], &word, sizeof word);
  }
  octets.insert(octets.end(), data.begin(), data.end());
  // A kernel that has released it closes the socket, which the next read detects.
  static_cast<void>(::send(socket_, octets.data(), octets.size(), MSG_NOSIGNAL));
}

void UsbipDevice::control(const Request& request) {
  const auto [type, what, index, kind, interface, none, length, more] = request.setup;
  std::optional<std::vector<std::uint8_t>> out;
  if ((type & USB_TYPE_MASK) != USB_TYPE_STANDARD) {
    out = model_.control(request.setup, request.data);
  } else if (what == USB_REQ_GET_DESCRIPTOR) {
    out = model_.descriptor(kind, index);
    if (out->empty()) out.reset();
  } else if (what == USB_REQ_GET_STATUS) {
    out = {0, 0};
  } else if (!request.is_in) {  // accepted: it has one configuration
    out.emplace();
  }
  answer(request, out ? 0 : -EPIPE, out.value_or(std::vector<std::uint8_t>{}));
}

}  // namespace reckon::test
