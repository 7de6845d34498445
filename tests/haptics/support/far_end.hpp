// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The far end of a real tty, a pseudo terminal of the kernel.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

namespace reckon::test {

/// Octets to it wait in the kernel until they are fetched. Its destructor hangs up the line.
class FarEnd {
 public:
  FarEnd() : descriptor_(posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)) {
    if (descriptor_ < 0 || grantpt(descriptor_) != 0 || unlockpt(descriptor_) != 0) std::abort();
  }
  ~FarEnd() { close(descriptor_); }
  FarEnd(const FarEnd&) = delete;
  FarEnd& operator=(const FarEnd&) = delete;

  /// Name of the near end.
  [[nodiscard]] std::string name() const {
    std::array<char, 64> name{};
    return ptsname_r(descriptor_, name.data(), name.size()) == 0 ? name.data() : "";
  }
  [[nodiscard]] int descriptor() const { return descriptor_; }
  [[nodiscard]] std::vector<std::uint8_t> fetch() const {
    std::vector<std::uint8_t> octets(4'096);
    const ssize_t length = read(descriptor_, octets.data(), octets.size());
    octets.resize(length > 0 ? static_cast<std::size_t>(length) : 0);
    return octets;
  }
  void send(const std::vector<std::uint8_t>& octets) const {
    EXPECT_EQ(write(descriptor_, octets.data(), octets.size()),
              static_cast<ssize_t>(octets.size()));
  }

 private:
  int descriptor_;
};

}  // namespace reckon::test
