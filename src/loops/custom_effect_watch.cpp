// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/custom_effect_watch.hpp"

#include <utility>

#include "reckon/peer/loops/notice_text.hpp"

namespace reckon::peer {
namespace {

using haptics::GuardReport;

struct Fault {
  bool (*seen)(const GuardReport& report);
  const char* sentence;  // of the effect's key, its object, and the longest call [ms]
};

constexpr Fault kFaults[]{
    {[](const GuardReport& report) { return report.not_finite.load() > 0; },
     "the effect {} of {} returns values that are not finite: they count as 0"},
    {[](const GuardReport& report) { return report.too_strong.load() > 0; },
     "the effect {} of {} gives forces above 100 N: they are limited to 100 N"},
    {[](const GuardReport& report) { return report.not_booked.load(); },
     "the spring of the effect {} of {} does not match its stated energy and stiffness: its force "
     "is held for each sample and limited to the available energy"},
    {[](const GuardReport& report) { return report.switched_off.load(); },
     "the effect {} of {} is switched off, because it took up to {:.1f} ms of a servo step"},
};
static_assert(haptics::CallGuard::kMostForce == 100.0, "as the sentence says");

}  // namespace

CustomEffectWatch::CustomEffectWatch(Reports reports) {
  for (auto& report : reports) watched_.push_back({std::move(report)});
}

void CustomEffectWatch::look(haptics::SpscRing<Notice>& out) noexcept {
  for (Watched& watched : watched_) {
    unsigned bit = 1;
    for (const Fault& fault : kFaults) {
      const GuardReport& report = *watched.report;
      if ((watched.told & bit) == 0 && fault.seen(report)) {
        watched.told |= bit;
        static_cast<void>(
            out.push(make_notice(NoticeKind::effect, fault.sentence, report.key, report.object,
                                 1e-6 * static_cast<double>(report.slowest.load()))));
      }
      bit <<= 1;
    }
  }
}

}  // namespace reckon::peer
