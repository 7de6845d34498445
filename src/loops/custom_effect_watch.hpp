// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reports faults of a program's own effects to the user: each fault of each effect once.
#pragma once

#include <memory>
#include <vector>

#include "reckon/haptics/effects/effect_guard.hpp"
#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/peer/loops/notice.hpp"

namespace reckon::peer {

/// One thread; allocates only at set-up.
class CustomEffectWatch {
 public:
  using Reports = std::vector<std::shared_ptr<const haptics::GuardReport>>;
  explicit CustomEffectWatch(Reports reports);

  /// Call it some times a second. @param out receives notices
  void look(haptics::SpscRing<Notice>& out) noexcept;

 private:
  struct Watched {
    std::shared_ptr<const haptics::GuardReport> report;
    unsigned told = 0;  ///< bits of the reported faults
  };
  std::vector<Watched> watched_;
};

}  // namespace reckon::peer
