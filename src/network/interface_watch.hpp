// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Notices of the kernel about changed interfaces or addresses of this host. Private to the peer
// library.
#pragma once

namespace reckon::peer {

/// An rtnetlink socket for changes of links and addresses. One thread.
class InterfaceWatch {
 public:
  /// If the host refuses the socket, descriptor() is negative, and the caller has to examine the
  /// host from time to time.
  InterfaceWatch() noexcept;
  ~InterfaceWatch();
  InterfaceWatch(const InterfaceWatch&) = delete;
  InterfaceWatch& operator=(const InterfaceWatch&) = delete;

  /// Readable after a change; for epoll.
  [[nodiscard]] int descriptor() const noexcept { return descriptor_; }
  /// Whether anything has changed since the last call, or notices were lost. Never blocks, no
  /// allocation.
  bool take_changes() noexcept;

 private:
  int descriptor_;
};

}  // namespace reckon::peer
