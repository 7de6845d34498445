// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/threads/thread_name.hpp"

#include <algorithm>
#include <array>

namespace reckon::peer {

void name_thread(pthread_t thread, std::string_view name) noexcept {
  std::array<char, kLongestThreadName + 1> text{};
  std::copy_n(name.begin(), std::min(name.size(), kLongestThreadName), text.begin());
  static_cast<void>(pthread_setname_np(thread, text.data()));
}

}  // namespace reckon::peer
