// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/serial/serial_port.hpp"

#include <fcntl.h>
#include <linux/serial.h>
#include <linux/termios.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <system_error>
#include <utility>

namespace reckon::haptics {
namespace {

using std::chrono::microseconds;

// An ioctl. The header of glibc supports few baud rates and conflicts with the kernel's header,
// which supports all. @return success; if false, errno has the reason
bool control(int descriptor, unsigned long request, auto argument) noexcept {
  return syscall(SYS_ioctl, descriptor, request, argument) == 0;
}

struct Trouble {
  std::string problem, remedy;
};

Trouble trouble_of_opening(const std::string& path, int error) {
  if (error == ENOENT || error == ENXIO || error == ENODEV)
    return {"there is no " + path, "plug it in; `reckon devices` lists ports"};
  if (error == EACCES || error == EPERM)
    return {"this user may not open " + path, "sudo usermod -aG dialout $USER, and log in again"};
  if (error == EBUSY || error == EWOULDBLOCK)
    return {"another program uses " + path, "end that program, for instance a serial monitor"};
  return {path + " cannot be opened: " + std::generic_category().message(error), ""};
}

// 8N1, no flow control, raw octets, no HUPCL. A board that resets when the line is opened does so
// only once, because close() leaves the modem lines up.
bool make_raw(int descriptor, unsigned baud) noexcept {
  termios2 mode{};
  if (!control(descriptor, TCGETS2, &mode)) return false;
  mode.c_iflag = 0;
  mode.c_oflag = 0;
  mode.c_lflag = 0;
  mode.c_cflag = CS8 | CREAD | CLOCAL | BOTHER | static_cast<tcflag_t>(BOTHER << IBSHIFT);
  mode.c_ispeed = mode.c_ospeed = baud;
  mode.c_cc[VMIN] = 0;
  mode.c_cc[VTIME] = 0;
  return control(descriptor, TCSETS2, &mode);
}

// An FTDI chip collects octets for 16 ms; this flag makes its driver set 1 ms. Other lines may lack
// the flag.
void ask_for_low_latency(int descriptor) noexcept {
  serial_struct line{};
  if (!control(descriptor, TIOCGSERIAL, &line)) return;
  line.flags |= ASYNC_LOW_LATENCY;
  static_cast<void>(control(descriptor, TIOCSSERIAL, &line));
}

timespec time_of(microseconds time) noexcept {
  return {time.count() / 1'000'000, 1'000 * (time.count() % 1'000'000)};
}

}  // namespace

SerialOpening SerialPort::open(const std::string& path, unsigned baud) {
  const auto refused = [](Trouble trouble) {
    return SerialOpening{nullptr, std::move(trouble.problem), std::move(trouble.remedy)};
  };
  const int descriptor = ::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return refused(trouble_of_opening(path, errno));
  std::unique_ptr<SerialPort> port(new SerialPort(descriptor));
  if (isatty(descriptor) == 0) return refused({path + " is not a serial port", ""});
  // TIOCEXCL does not exclude root, so the lock is needed too.
  if (!control(descriptor, TIOCEXCL, 0) || flock(descriptor, LOCK_EX | LOCK_NB) != 0)
    return refused(trouble_of_opening(path, errno));
  if (!make_raw(descriptor, baud)) {
    return refused({path + " does not support " + std::to_string(baud) +
                        " baud: " + std::generic_category().message(errno),
                    "set another 'baud'"});
  }
  ask_for_low_latency(descriptor);
  static_cast<void>(control(descriptor, TCFLSH, TCIOFLUSH));
  return {std::move(port), {}, {}};
}

// Unsent octets would block close() for half a minute, and reach the board after the port is
// closed. Without unsent octets there is no flush: it would drop what the other end of a pseudo
// terminal has not read yet.
SerialPort::~SerialPort() {
  int waiting = 0;
  if (control(descriptor_, TIOCOUTQ, &waiting) && waiting > 0)
    static_cast<void>(control(descriptor_, TCFLSH, TCOFLUSH));
  static_cast<void>(control(descriptor_, TIOCNXCL, 0));
  close(descriptor_);
}

void SerialPort::wait(microseconds longest) noexcept {
  if (gone_) return;
  const bool waits = out_begin_ < out_end_;
  pollfd line{descriptor_, static_cast<short>(waits ? POLLIN | POLLOUT : POLLIN), 0};
  const timespec time = time_of(longest);
  if (ppoll(&line, 1, &time, nullptr) <= 0) return;
  // Octets received before a hang-up are of no use.
  if ((line.revents & (POLLHUP | POLLERR | POLLNVAL)) != 0) gone_ = true;
}

std::span<const std::uint8_t> SerialPort::read() noexcept {
  if (gone_) return {};
  const ssize_t length = ::read(descriptor_, in_.data(), in_.size());
  if (length > 0) return std::span(in_).first(static_cast<std::size_t>(length));
  // An open raw line without data reads 0, and so does one after a hang-up: wait() distinguishes
  // them.
  if (length < 0 && errno != EAGAIN && errno != EINTR) gone_ = true;
  return {};
}

void SerialPort::write_on() noexcept {
  while (!gone_ && out_begin_ < out_end_) {
    const ssize_t length = ::write(descriptor_, out_.data() + out_begin_, out_end_ - out_begin_);
    if (length < 0 && errno == EAGAIN) return;
    if (length < 0 && errno != EINTR) gone_ = true;
    if (length > 0) out_begin_ += static_cast<std::size_t>(length);
  }
}

bool SerialPort::is_sending() noexcept {
  write_on();
  if (out_begin_ < out_end_) return true;
  int waiting = 0;
  return control(descriptor_, TIOCOUTQ, &waiting) && waiting > 0;
}

void SerialPort::send(std::span<const std::uint8_t> octets) noexcept {
  const std::size_t length = std::min(octets.size(), out_.size());
  std::copy_n(octets.begin(), length, out_.begin());
  out_begin_ = 0;
  out_end_ = length;
  write_on();
}

void wait_without_line(microseconds longest) noexcept {
  const timespec time = time_of(longest);
  nanosleep(&time, nullptr);
}

}  // namespace reckon::haptics
