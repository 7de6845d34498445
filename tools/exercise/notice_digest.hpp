// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Groups notices of several peers, so that an event common to all of them is one sentence.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

#include "reckon/aoim/presence/presence.hpp"
#include "reckon/peer/loops/notice.hpp"

namespace reckon::tools {

/// A notice and the peer of this program that received it.
struct ReceivedNotice {
  aoim::PeerId by;
  peer::Notice notice;
};

/// Gathers notices of one kind, or with the same sentence, until none has come for kCalm, or for
/// kLongest at most. One thread.
///
///   8 peers: each sees 7 others
///   1:2: peer 9:1 'BOB' runs another scene and is not joined; start both with the same file
class NoticeDigest {
 public:
  static constexpr std::chrono::nanoseconds kCalm = std::chrono::milliseconds(300);
  static constexpr std::chrono::nanoseconds kLongest = std::chrono::seconds(1);

  /// @param several whether this program has more than one peer: then a sentence begins with the
  /// peer of its notice.
  explicit NoticeDigest(bool several) : several_(several) {}

  void add(const ReceivedNotice& heard, std::chrono::nanoseconds now);
  /// The sentences that are ready, in the order of their first notices.
  [[nodiscard]] std::vector<std::string> take(std::chrono::nanoseconds now);
  /// All pending sentences.
  [[nodiscard]] std::vector<std::string> take_all();

 private:
  struct Group {
    std::chrono::nanoseconds first, last;
    std::vector<ReceivedNotice> members;
  };
  [[nodiscard]] std::string sentence(const Group& group) const;

  bool several_;
  std::vector<Group> groups_;
};

}  // namespace reckon::tools
