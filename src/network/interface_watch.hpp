// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Learns from the kernel that interfaces or addresses of this host have changed. Private to the
// peer library.
#pragma once

namespace reckon::peer {

/// An rtnetlink socket that listens for changes of links and of addresses. One thread.
class InterfaceWatch {
 public:
  /// Where the host refuses the socket there is none: descriptor() is negative then, and who wants
  /// to know has to look from time to time.
  InterfaceWatch() noexcept;
  ~InterfaceWatch();
  InterfaceWatch(const InterfaceWatch&) = delete;
  InterfaceWatch& operator=(const InterfaceWatch&) = delete;

  /// Readable when something has changed; for epoll.
  [[nodiscard]] int descriptor() const noexcept { return descriptor_; }
  /// Whether anything has changed since the last call, or more than the kernel could tell. Never
  /// blocks, no allocation.
  bool take_changes() noexcept;

 private:
  int descriptor_;
};

}  // namespace reckon::peer
