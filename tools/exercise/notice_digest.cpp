// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/notice_digest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

using peer::NoticeKind;
using std::chrono::nanoseconds;

constexpr std::size_t kNamed = 4;  // peers named in a sentence

// Orders peers by their numbers.
using Numbers = std::pair<unsigned, unsigned>;
Numbers numbers_of(const aoim::PeerId& peer) { return {peer.site, peer.application}; }

struct Words {
  NoticeKind kind;
  std::string_view many;  ///< "7 peers .."
  std::string_view each;  ///< "8 peers: each .."
};
constexpr Words kWords[] = {
    {NoticeKind::joined, "joined", "sees {}"},
    {NoticeKind::started_anew, "restarted", "saw {} restart"},
    {NoticeKind::left, "left", "saw {} leave"},
    {NoticeKind::silent, "are silent: their entities were dropped",
     "dropped the entities of {} for silence"},
    {NoticeKind::other_scene, "run another scene and are not joined; start all with the same file",
     "met {} with another scene, not joined; start all with the same file"},
    {NoticeKind::quiet, "were silent for 2.5 s", "has received nothing from {} for 2.5 s"},
    {NoticeKind::unheard, "do not receive this one: see `reckon doctor` on all hosts",
     "is not received by {}: see `reckon doctor` on all hosts"},
    {NoticeKind::heard_again, "and this one receive each other again",
     "and {} receive each other again"},
};

bool has_words(NoticeKind kind) {
  return std::ranges::find(kWords, kind, &Words::kind) != std::end(kWords);
}

std::string names(const std::set<Numbers>& peers) {
  std::string text;
  std::size_t named = 0;
  for (const auto& [site, application] : peers) {
    if (named == kNamed) return text + fmt::format(" and {} more", peers.size() - named);
    text += fmt::format("{}{}:{}", named++ == 0 ? "" : ", ", site, application);
  }
  return text;
}

}  // namespace

void NoticeDigest::add(const ReceivedNotice& heard, nanoseconds now) {
  const auto same = [&](const Group& group) {
    const peer::Notice& other = group.members.front().notice;
    if (other.kind != heard.notice.kind) return false;
    return has_words(other.kind) || std::string_view(other.text.data()) == heard.notice.text.data();
  };
  auto group = std::find_if(groups_.begin(), groups_.end(), same);
  if (group == groups_.end()) group = groups_.insert(group, {now, now, {}});
  group->last = now;
  group->members.push_back(heard);
}

std::vector<std::string> NoticeDigest::take(nanoseconds now) {
  std::vector<std::string> ready;
  std::erase_if(groups_, [&](const Group& group) {
    if (now - group.last < kCalm && now - group.first < kLongest) return false;
    ready.push_back(sentence(group));
    return true;
  });
  return ready;
}

std::vector<std::string> NoticeDigest::take_all() {
  std::vector<std::string> all;
  for (const Group& group : std::exchange(groups_, {})) all.push_back(sentence(group));
  return all;
}

std::string NoticeDigest::sentence(const Group& group) const {
  const ReceivedNotice& first = group.members.front();
  const std::string by =
      several_ ? fmt::format("{}:{}: ", first.by.site, first.by.application) : "";
  if (group.members.size() == 1) return by + first.notice.text.data();

  std::map<Numbers, std::size_t> tellers;
  std::set<Numbers> about;
  for (const ReceivedNotice& heard : group.members) {
    ++tellers[numbers_of(heard.by)];
    about.insert(numbers_of(heard.notice.about));
  }
  const std::size_t each = tellers.begin()->second;
  const bool alike = std::all_of(tellers.begin(), tellers.end(),
                                 [&](const auto& teller) { return teller.second == each; });
  const auto words = std::find_if(std::begin(kWords), std::end(kWords),
                                  [&](const Words& row) { return row.kind == first.notice.kind; });
  if (words == std::end(kWords)) {  // one sentence, several times
    const std::string text(first.notice.text.data());
    if (tellers.size() > 1) return fmt::format("{} peers: {}", tellers.size(), text);
    return fmt::format("{}{} ({} times)", by, text, group.members.size());
  }
  const std::string who = tellers.size() == 1 ? by : fmt::format("{} peers: ", tellers.size());
  if (about.size() == 1) {
    const std::size_t count = group.members.size();
    return who + first.notice.text.data() +
           (count == tellers.size() ? "" : fmt::format(" ({} times)", count));
  }
  if (tellers.size() > 1 && alike) {
    return who + "each " + fmt::format(fmt::runtime(words->each), counted(each, "other"));
  }
  return fmt::format("{}{} {} {}: {}", who, about.size(), tellers.size() == 1 ? "peers" : "others",
                     words->many, names(about));
}

}  // namespace reckon::tools
