// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A file descriptor with one owner. Private to the peer library.
#pragma once

#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace reckon::peer {

/// Closes its file descriptor at its end.  @throws std::system_error with `what` if it is negative.
class Descriptor {
 public:
  Descriptor(int value, const char* what) : value_(value) {
    if (value < 0) throw std::system_error(errno, std::generic_category(), what);
  }
  ~Descriptor() { ::close(value_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int get() const noexcept { return value_; }

 private:
  int value_;
};

}  // namespace reckon::peer
