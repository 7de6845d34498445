// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/link_watch.hpp"

#include <algorithm>
#include <cstring>
#include <string_view>
#include <utility>

#include "reckon/peer/loops/notice_text.hpp"

namespace reckon::peer {
namespace {

using Turn = NoticeCondition::Turn;

/// Text and remedy of an errno, without an allocation.
struct Reason {
  std::string_view what, separator, remedy;
};

Reason reason_of(int error, std::string_view (*remedy)(const std::error_code&) noexcept) noexcept {
  const char* const what = strerrordesc_np(error);
  const std::string_view to_do = remedy({error, std::generic_category()});
  return {what == nullptr ? "an unknown error" : what, to_do.empty() ? "" : "; ", to_do};
}

// A single refusal is reported after this time.
constexpr std::chrono::nanoseconds kLoneRefusal = std::chrono::milliseconds(500);

}  // namespace

LinkWatch::LinkWatch(Link& link, const GroupAddress& base, std::size_t longest_bundle,
                     Counters& counters)
    : link_(link),
      longest_bundle_(longest_bundle),
      base_unjoined_(counters.make("base_unjoined", "1 while the base group is not joined")),
      groups_unjoined_(
          counters.make("groups_unjoined", "of these, groups that are still not joined")) {
  base.text().copy(base_.data(), base_.size() - 1);
}

void LinkWatch::look(std::chrono::nanoseconds now, haptics::SpscRing<Notice>& out) noexcept {
  now_ = now;
  out_ = &out;
  // The reading thread continues meanwhile, so the missing count is read before its reason.
  const bool is_deaf = base_unjoined_.value() > 0;
  const std::uint64_t unjoined = groups_unjoined_.value();
  at_ = link_.statistics();
  LinkEvent event;
  while (link_.take_event(event))
    report(NoticeKind::interface, "{}", std::string_view(event.text.data()));
  report_payload();
  report_base(is_deaf);
  report_groups(unjoined - std::min<std::uint64_t>(unjoined, is_deaf ? 1 : 0));
  report_sends();
  report_drops();
  before_ = at_;
  out_ = nullptr;
}

void LinkWatch::report_payload() noexcept {
  const std::size_t asked = std::exchange(longest_bundle_, 0), most = link_.max_payload();
  if (most > 0 && asked > most)
    report(NoticeKind::payload_cut,
           "bundles are limited to {} octets by the MTU: [network.bundle] max = {}", most, asked);
}

void LinkWatch::report_base(bool is_deaf) noexcept {
  const Turn turn = deaf_.turn(is_deaf, now_);
  if (turn == Turn::begins) {
    const Reason reason = reason_of(at_.last_join_error, join_remedy);
    report(NoticeKind::base_unjoined,
           "DEAF: no peer is received, because the base group {} cannot be joined: {}{}{}; retries "
           "each second",
           base_.data(), reason.what, reason.separator, reason.remedy);
  }
  if (turn == Turn::ends)
    end(NoticeKind::base_unjoined, "the base group {} is joined: peers are received", base_.data());
}

// Confirmed in the next call: the two counts are written one after the other, and the base group
// may be in only one of them.
void LinkWatch::report_groups(std::uint64_t count) noexcept {
  const bool were_any = std::exchange(any_unjoined_, count > 0);
  const Turn turn = unjoined_.turn(were_any && count > 0, now_);
  if (turn == Turn::begins) {
    const Reason reason = reason_of(at_.last_join_error, join_remedy);
    report(NoticeKind::groups_unjoined,
           "{} groups cannot be joined, and their datagrams are not received: {}{}{}; retries each "
           "second",
           count, reason.what, reason.separator, reason.remedy);
  }
  if (turn == Turn::ends) end(NoticeKind::groups_unjoined, "all groups are joined");
}

// Whether all sends fail is known only after the call that finds the first failure, because that
// call also contains earlier successes.
void LinkWatch::report_sends() noexcept {
  bool fails = at_.send_errors > before_.send_errors;
  if (fails && !refusal_) {
    refusal_ = Refusal{now_, at_.sent, false};
    fails = false;
  } else if (refusal_ && !refusal_->reported) {
    fails = fails || now_ - refusal_->since >= kLoneRefusal;
  }
  const Turn turn = unsent_.turn(fails, now_);
  if (turn == Turn::begins) {
    const Reason reason = reason_of(at_.last_send_error, send_remedy);
    report(NoticeKind::send_fails, "{} fails: {}{}{}",
           at_.sent > refusal_->sent ? "sending some datagrams" : "SENDING", reason.what,
           reason.separator, reason.remedy);
    refusal_->reported = true;
  }
  if (turn == Turn::ends) refusal_.reset();
  if (turn == Turn::ends)
    end(NoticeKind::send_fails, "sending works again; the kernel refused {} datagrams",
        at_.send_errors);
  const Turn held = held_.turn(at_.held_back > before_.held_back, now_);
  if (held == Turn::begins) {
    report(NoticeKind::held_back,
           "the interface is slower than the traffic: states that would wait for more than 50 ms "
           "are not sent; larger thresholds in [dead_reckoning] send less");
  }
  if (held == Turn::ends)
    end(NoticeKind::held_back, "the interface sends everything again; {} were not sent",
        at_.held_back);
}

void LinkWatch::report_drops() noexcept {
  const Turn turn = dropped_.turn(at_.kernel_drops > before_.kernel_drops, now_);
  if (turn == Turn::begins) {
    report(NoticeKind::kernel_drops,
           "the kernel drops datagrams, because its receive buffer is full: end other load, or "
           "sysctl -w net.core.rmem_max=33554432");
  }
  if (turn == Turn::ends)
    end(NoticeKind::kernel_drops, "the kernel drops no datagrams any more; {} were lost",
        at_.kernel_drops);
}

template <typename... Arguments>
void LinkWatch::report(NoticeKind kind, const char* format,
                       const Arguments&... arguments) noexcept {
  static_cast<void>(out_->push(make_notice(kind, format, arguments...)));
}

template <typename... Arguments>
void LinkWatch::end(NoticeKind kind, const char* format, const Arguments&... arguments) noexcept {
  static_cast<void>(out_->push(make_end(kind, format, arguments...)));
}

}  // namespace reckon::peer
