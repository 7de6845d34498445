// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/haptics/support/serial_shim.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdarg>
#include <cstdlib>
#include <ctime>
#include <string_view>
#include <utility>

#include "reckon/haptics/serial/serial_packets.hpp"

extern "C" {
int __real_open(const char* path, int flags, ...);
int __real_close(int file);
}

namespace reckon::test {
namespace {

using std::chrono::microseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

constexpr nanoseconds kTick = microseconds(50);
// Time for which the kernel waits on closing for octets in transit.
constexpr seconds kClosingWait{30};
constexpr int kWeak = 100;  // [mN]

SerialShim* the_shim = nullptr;

int refuse(int error) {
  errno = error;
  return -1;
}

}  // namespace

SerialShim* SerialShim::that_is_there() { return the_shim; }

SerialShim::SerialShim(SerialBoard& board, std::string path, nanoseconds out, nanoseconds in)
    : board_(board), path_(std::move(path)), out_latency_(out), in_latency_(in) {
  if (the_shim != nullptr) std::abort();
  the_shim = this;
  in_.latency = in;
  out_.latency = out;
}

SerialShim::~SerialShim() { the_shim = nullptr; }

void SerialShim::pass(nanoseconds time) {
  for (const nanoseconds end = board_.now() + time; board_.now() < end;) {
    for (std::vector<std::uint8_t>& frame : board_.pass()) bring(std::move(frame));
    if (false_ == FalseBoard::noisy && happens(100))
      bring({static_cast<std::uint8_t>(random_()), static_cast<std::uint8_t>(random_())});
    take_in();
    send_out();
    for (const std::uint8_t octet : out_.take(board_.now())) {
      const bool is_lost = board_.now() < lost_until_ && happens(lost_);
      if (!is_lost && false_ != FalseBoard::silent) board_.take(octet);
    }
    if (beside_) beside_(board_.now());
  }
}

// From the board.
void SerialShim::bring(std::vector<std::uint8_t> frame) {
  if (!plugged_ || board_.now() < mute_until_ || false_ == FalseBoard::silent) return;
  if (false_ == FalseBoard::newer) {
    for (const std::uint8_t octet : std::exchange(frame, {})) {
      const auto carried = parser_.take(octet);
      if (carried.empty()) continue;
      std::vector<std::uint8_t> changed(carried.begin(), carried.end());
      if (haptics::serial_version(changed)) ++changed[1];
      const haptics::SerialFrame told = haptics::serial_frame(changed);
      frame.insert(frame.end(), told.span().begin(), told.span().end());
    }
  }
  if (damaged_in_ > 0 && !frame.empty()) {
    --damaged_in_;
    flip(frame);
  }
  if (board_.now() < lost_until_)
    std::erase_if(frame, [this](std::uint8_t) { return happens(lost_); });
  in_.send(frame, board_.now());
}

void SerialShim::flip(std::vector<std::uint8_t>& octets) {
  std::uint8_t& octet = octets[random_() % octets.size()];
  octet = static_cast<std::uint8_t>(octet ^ (1U << random_() % 8));
}

void SerialShim::take_in() {
  const nanoseconds now = board_.now();
  for (const std::uint8_t octet : in_.take(now)) held_.push_back(octet);
  if (now < bunched_until_ && now / bunch_ == (now - kTick) / bunch_) return;
  for (; !held_.empty(); held_.pop_front())
    if (files_ > 0 && !hung_up_ && to_host_.size() < kRoom) to_host_.push_back(held_.front());
}

void SerialShim::send_out() {
  if (to_board_.empty() || board_.now() < hangs_until_) return;
  std::vector<std::uint8_t> octets(to_board_.begin(), to_board_.end());
  to_board_.clear();
  if (damaged_out_ > 0) {
    --damaged_out_;
    flip(octets);
  }
  out_.send(octets, board_.now());
}

void SerialShim::unplug() {
  plugged_ = false;
  hung_up_ = true;
  errors_ = 0;
  in_ = out_ = LineWay();
  in_.latency = in_latency_;
  out_.latency = out_latency_;
  to_board_.clear();
  to_host_.clear();
  held_.clear();
}

void SerialShim::plug(FalseBoard board) {
  if (std::exchange(false_, board) == FalseBoard::weaker) board_.forget();
  if (board == FalseBoard::weaker) {
    board_.forget();
    for (reckon_axis& axis : board_.program.axis) axis.most_force = kWeak;
  }
  plugged_ = true;
}

void SerialShim::lose(unsigned of_thousand, nanoseconds time) {
  lost_ = of_thousand;
  lost_until_ = board_.now() + time;
}

void SerialShim::bunch(nanoseconds every, nanoseconds time) {
  bunch_ = every;
  bunched_until_ = board_.now() + time;
}

void SerialShim::restart() {
  constexpr std::string_view kWords = "\r\nrst cause:2, boot mode:(3,6)\r\n";
  board_.forget();
  bring({kWords.begin(), kWords.end()});
}

bool SerialShim::fails() {
  if (errors_ == 0) return false;
  --errors_;
  return true;
}

int SerialShim::open() {
  if (at_call_) at_call_();
  ++tries_;
  if (!plugged_) return refuse(ENOENT);
  if (denied_ != 0) return refuse(denied_);
  const int file = __real_open("/dev/null", O_RDWR | O_CLOEXEC);
  if (file < 0 || files_ > 0) std::abort();
  ++files_;
  hung_up_ = false;
  return file_ = file;
}

int SerialShim::close() {
  if (at_call_) at_call_();
  for (const nanoseconds end = board_.now() + kClosingWait; waiting() > 0 && board_.now() < end;)
    pass(kTick);
  to_board_.clear();
  to_host_.clear();
  --files_;
  return __real_close(std::exchange(file_, -1));
}

std::size_t SerialShim::waiting() const {
  if (hung_up_) return 0;
  return to_board_.size() + (out_.is_sending(board_.now()) ? 1 : 0);
}

int SerialShim::control(unsigned long request, void* argument) {
  if (at_call_) at_call_();
  if (hung_up_) return refuse(EIO);
  switch (request) {
    case TIOCOUTQ:
      *static_cast<int*>(argument) = static_cast<int>(waiting());
      return 0;
    case TCFLSH: {
      const auto queue = reinterpret_cast<std::intptr_t>(argument);
      if (queue != TCOFLUSH) to_host_.clear();
      if (queue != TCIFLUSH) to_board_.clear();
      return 0;
    }
    case TIOCGSERIAL:
      return refuse(ENOTTY);
    default:
      return 0;
  }
}

short SerialShim::poll(short wanted, nanoseconds longest) {
  if (at_call_) at_call_();
  const auto events = [&]() -> short {
    if (hung_up_) return POLLIN | POLLOUT | POLLERR | POLLHUP;
    const bool takes = to_board_.size() < kRoom;
    return static_cast<short>(wanted & ((is_readable() ? POLLIN : 0) | (takes ? POLLOUT : 0)));
  };
  for (const nanoseconds end = board_.now() + longest; events() == 0 && board_.now() < end;)
    pass(kTick);
  return events();
}

// A hung-up line reads nothing, like a silent one.
std::ptrdiff_t SerialShim::read(std::span<std::uint8_t> octets) {
  if (at_call_) at_call_();
  if (hung_up_) return 0;
  if (fails()) return refuse(EIO);
  std::size_t count = std::min(octets.size(), to_host_.size());
  if (pieces_) count = std::min<std::size_t>(count, 1 + random_() % 7);
  std::copy_n(to_host_.begin(), count, octets.begin());
  to_host_.erase(to_host_.begin(), to_host_.begin() + static_cast<std::ptrdiff_t>(count));
  return static_cast<std::ptrdiff_t>(count);
}

std::ptrdiff_t SerialShim::write(std::span<const std::uint8_t> octets) {
  if (at_call_) at_call_();
  if (hung_up_ || fails()) return refuse(EIO);
  std::size_t count = std::min(octets.size(), kRoom - to_board_.size());
  if (pieces_) count = std::min<std::size_t>(count, 1 + random_() % 7);
  if (count == 0) return refuse(EAGAIN);
  to_board_.insert(to_board_.end(), octets.begin(),
                   octets.begin() + static_cast<std::ptrdiff_t>(count));
  return static_cast<std::ptrdiff_t>(count);
}

}  // namespace reckon::test

using reckon::test::SerialShim;

namespace {

SerialShim* shim_of(int file) {
  SerialShim* const shim = SerialShim::that_is_there();
  return shim != nullptr && shim->is_its(file) ? shim : nullptr;
}

std::chrono::nanoseconds time_of(const timespec& time) {
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

}  // namespace

extern "C" {

int __real_isatty(int file);
int __real_flock(int file, int what);
long __real_syscall(long number, ...);
int __real_ppoll(pollfd* files, nfds_t count, const timespec* time, const sigset_t* signals);
ssize_t __real_read(int file, void* octets, std::size_t count);
ssize_t __real_write(int file, const void* octets, std::size_t count);
int __real_nanosleep(const timespec* time, timespec* left);

int __wrap_open(const char* path, int flags, ...) {
  SerialShim* const shim = SerialShim::that_is_there();
  if (shim != nullptr && shim->is_its(path)) return shim->open();
  std::va_list arguments;
  va_start(arguments, flags);
  const bool creates = (flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE;
  const unsigned mode = creates ? va_arg(arguments, unsigned) : 0;
  va_end(arguments);
  return __real_open(path, flags, mode);
}

int __wrap_close(int file) {
  SerialShim* const shim = shim_of(file);
  return shim != nullptr ? shim->close() : __real_close(file);
}

int __wrap_isatty(int file) { return shim_of(file) != nullptr ? 1 : __real_isatty(file); }

int __wrap_flock(int file, int what) {
  return shim_of(file) != nullptr ? 0 : __real_flock(file, what);
}

long __wrap_syscall(long number, ...) {
  std::array<long, 6> all{};
  // it has no further arguments to read
  const std::size_t passed = number == SYS_ioctl ? 3 : all.size();
  std::va_list arguments;
  va_start(arguments, number);
  for (std::size_t i = 0; i < passed; ++i) all[i] = va_arg(arguments, long);
  va_end(arguments);
  SerialShim* const shim = number == SYS_ioctl ? shim_of(static_cast<int>(all[0])) : nullptr;
  if (shim == nullptr)
    return __real_syscall(number, all[0], all[1], all[2], all[3], all[4], all[5]);
  return shim->control(static_cast<unsigned long>(all[1]), reinterpret_cast<void*>(all[2]));
}

int __wrap_ppoll(pollfd* files, nfds_t count, const timespec* time, const sigset_t* signals) {
  SerialShim* const shim = count == 1 ? shim_of(files->fd) : nullptr;
  if (shim == nullptr) return __real_ppoll(files, count, time, signals);
  files->revents = shim->poll(files->events, time_of(*time));
  return files->revents != 0 ? 1 : 0;
}

ssize_t __wrap_read(int file, void* octets, std::size_t count) {
  SerialShim* const shim = shim_of(file);
  if (shim == nullptr) return __real_read(file, octets, count);
  return shim->read({static_cast<std::uint8_t*>(octets), count});
}

ssize_t __wrap_write(int file, const void* octets, std::size_t count) {
  SerialShim* const shim = shim_of(file);
  if (shim == nullptr) return __real_write(file, octets, count);
  return shim->write({static_cast<const std::uint8_t*>(octets), count});
}

int __wrap_nanosleep(const timespec* time, timespec* left) {
  SerialShim* const shim = SerialShim::that_is_there();
  if (shim == nullptr) return __real_nanosleep(time, left);
  shim->pass(time_of(*time));
  return 0;
}
}
