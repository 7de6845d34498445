// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Recipient of finished datagrams: a reference to any callable, without the allocation of
// std::function.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>

#include "reckon/aoim/groups/group_index.hpp"

namespace reckon::aoim {

/// Refers to a callable with (GroupIndex, std::span<const std::byte>), which must outlive the call
/// that gets it; the span is valid only during the call.
class DatagramSink {
 public:
  template <typename Callable>
  requires(!std::is_same_v<std::remove_cvref_t<Callable>, DatagramSink>)
      DatagramSink(Callable&& callable)
  noexcept  // NOLINT: meant to convert
      : object_(const_cast<void*>(static_cast<const void*>(std::addressof(callable)))),
        call_([](void* object, GroupIndex group, std::span<const std::byte> datagram) {
          (*static_cast<std::remove_reference_t<Callable>*>(object))(group, datagram);
        }) {}

  void operator()(GroupIndex group, std::span<const std::byte> datagram) const {
    call_(object_, group, datagram);
  }

 private:
  void* object_;
  void (*call_)(void*, GroupIndex, std::span<const std::byte>);
};

}  // namespace reckon::aoim
