// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What `reckon inspect` says of the owners of bodies: each message of peers, and each change.
#include <gmock/gmock.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reckon/pdu/pdu_types.hpp"
#include "reckon/peer/ownership/message_codec.hpp"
#include "reckon/tests/support/capture_builder.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"

namespace reckon::tools {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;
using test::Octets;
using test::run_reckon;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::chrono::nanoseconds kStart = 1'700'000'000s;
constexpr std::uint32_t kOurs = 0x4A11C0DE, kTheirs = 0xB0B;

template <typename Pdu>
void append(Octets& datagram, const Pdu& pdu) {
  const std::size_t begin = datagram.size();
  datagram.resize(begin + wire_size(pdu));
  ASSERT_GT(encode(pdu, std::span(datagram).subspan(begin)), 0U);
}

/// The message as a peer sends it, in a datagram of its own: inside an Assured Record, or as the
/// plain PDU that comes first.
Octets sent(const peer::OwnershipMessage& message, bool is_plain = false) {
  Octets content(pdu::kMostAssured);
  const peer::TransferNames names{1, {1, 1}, {1, 2}, {65534, 1}};
  const peer::EncodedMessage encoded = encode_message(message, names, 0, content);
  EXPECT_GT(encoded.size, 0U);
  content.resize(encoded.size);
  if (is_plain) return content;
  pdu::AssuredRecord record;
  record.simulation = {1, 1};
  record.epoch = kOurs;
  record.kind = encoded.kind;
  record.flags = encoded.is_pdu ? pdu::kAssuredPdu : pdu::kAssuredOnce;
  record.content = {static_cast<std::uint16_t>(content.size()), content};
  Octets datagram;
  append(datagram, record);
  return datagram;
}

/// The text of the PDU in `tail`; the same text is a member of the JSON line.
std::string shown(const Octets& datagram) {
  test::CaptureBuilder capture;
  capture.add(datagram, kStart);
  const std::string file = capture.path();
  const json line = json::parse(run_reckon({"inspect", file, "--json"}).out);
  const std::string text = line.value("about_owners", "");
  if (!text.empty()) {
    EXPECT_THAT(run_reckon({"inspect", file, "tail"}).out, HasSubstr("; " + text));
  }
  return text;
}

peer::Grant grant_of(std::size_t count) {
  peer::Grant grant;
  grant.world = {1, kOurs};
  grant.transaction = 17;
  grant.to = kTheirs;
  grant.count = count;
  for (std::size_t i = 0; i < 10; ++i) grant.objects.set(i);
  for (std::size_t i = 0; i < count; ++i)
    grant.part[i] = {static_cast<std::uint16_t>(3 + i), {peer::version_of(2, 5), kTheirs}};
  return grant;
}

TEST(InspectOwners, DescribesEachMessageOfPeers) {
  EXPECT_EQ(shown(sent(grant_of(2))),
            "gives 3 2.5, 4 2.5 to 00000b0b (together: 0, 1, 2, 3, 4, 5, 6, 7 and 2 more)");
  EXPECT_EQ(shown(sent(grant_of(1), true)), shown(sent(grant_of(1)))) << "before its repeats";

  peer::Request request{{1, kOurs}, {}, false};
  request.objects.set(5);
  EXPECT_EQ(shown(sent(request)), "asks for 5");
  request.withdraws = true;
  EXPECT_EQ(shown(sent(request)), "no longer asks for 5");
  EXPECT_EQ(shown(sent(peer::GrantRefusal{{}, 17}, true)), "refuses grant 17");

  peer::Round round;
  round.world = {1, kOurs};
  round.act = 3;
  round.round = 9;
  round.is_decided = round.has_lease = true;
  round.heard[1] = 8;
  EXPECT_EQ(shown(sent(round)), "round 9 of act 3, has a lease, receives 1 voter");
  round.yields_to = peer::kAnyAct;
  EXPECT_THAT(shown(sent(round)), HasSubstr(", leaves,"));

  peer::Proposal proposal;
  proposal.world = {1, kOurs};
  proposal.act.number = 4;
  proposal.act.chair = kOurs;
  EXPECT_TRUE(proposal.act.roll.add({kOurs, 0}) && proposal.act.remove(kTheirs));
  proposal.act.given.set(7);
  proposal.ballot = {1, kOurs};
  EXPECT_EQ(shown(sent(proposal)),
            "proposes act 4, attempt 1 of 4a11c0de: 1 voter, 1 removed, gives 7 to 4a11c0de");
  EXPECT_EQ(shown(sent(peer::Vote{{1, kOurs}, 4, {1, kOurs}})),
            "votes for act 4, attempt 1 of 4a11c0de");

  peer::TableExtract extract;
  extract.world = {1, kOurs};
  extract.asks = true;
  extract.holdings.add(6, {peer::version_of(1, 0), kOurs});
  EXPECT_EQ(shown(sent(extract)), "owners, to be agreed on: 6 of 4a11c0de 1.0");
  peer::Agreement agreement{{1, kOurs}, 1, {}};
  agreement.objects.set(6);
  EXPECT_EQ(shown(sent(agreement)), "agrees on the owners of 6");
}

TEST(InspectOwners, SaysNothingOfOtherContents) {
  pdu::AssuredRecord record;
  record.kind = pdu::AssuredKind::ownership_vote;
  const Octets content(3, std::byte{1});  // cut short
  record.content = {3, content};
  Octets datagram;
  append(datagram, record);
  EXPECT_EQ(shown(datagram), "");
  pdu::Acknowledge obeyed;
  obeyed.acknowledge_flag = pdu::AcknowledgeFlag::stop_freeze;
  datagram.clear();
  append(datagram, obeyed);
  EXPECT_EQ(shown(datagram), "");
}

/// A state of body 3 with its owner.
Octets stated(std::uint32_t owner, std::uint64_t version) {
  std::array<std::byte, 256> buffer{};
  pdu::AttributeWriter writer(buffer, pdu::Attribute{});
  pdu::OwnershipRecord record;
  record.owner = owner;
  record.version = version;
  EXPECT_TRUE(writer.begin_set({65534, 1, 4}) && writer.add(record));
  return {buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(writer.finish())};
}

TEST(InspectOwners, ListsFormerAndNewOwners) {
  test::CaptureBuilder capture;
  pdu::Presence presence;
  presence.simulation = {1, 1};
  presence.epoch = kOurs;
  Octets announced;
  append(announced, presence);
  capture.add(announced, kStart);
  capture.add(stated(kOurs, peer::version_of(1, 0)), kStart + 1s);
  capture.add(stated(kTheirs, peer::version_of(1, 1)), kStart + 2s);
  capture.add(stated(kTheirs, peer::version_of(1, 1)), kStart + 3s);
  capture.add(stated(kOurs, peer::version_of(1, 0)), kStart + 4s);  // late
  capture.add(stated(kOurs, peer::version_of(2, 0)), kStart + 5s);
  const std::string file = capture.path();
  std::vector<std::string> changes;
  for (const std::string& line : run_reckon({"inspect", file, "owners", "--json"}).lines()) {
    const json row = json::parse(line);
    EXPECT_EQ(row["body"], "65534:1:4");
    changes.push_back(std::string(row["from"]) + " > " + std::string(row["to"]) + " " +
                      std::string(row["version"]) + " " + std::string(row["cause"]));
  }
  EXPECT_THAT(changes, ElementsAre("- > 1:1 1.0 founded", "1:1 > 00000b0b 1.1 granted",
                                   "00000b0b > 1:1 2.0 adopted"));
  const auto text = run_reckon({"inspect", file, "owners"}).lines();
  ASSERT_EQ(text.size(), 5U);
  EXPECT_THAT(text[2], HasSubstr("2.000000  65534:1:4         1:1          00000b0b     1.1      "
                                 "granted"));
  EXPECT_EQ(text[4], "3 changes of owner");
  EXPECT_THAT(run_reckon({"inspect", file, "owners", "--csv"}).lines()[3],
              HasSubstr(",65534:1:4,00000b0b,1:1,2.0,adopted"));
}

// The owner of the body continues with a higher version.
TEST(InspectOwners, RefusedGrantIsNoChange) {
  test::CaptureBuilder capture;
  capture.add(stated(kOurs, peer::version_of(2, 4)), kStart);
  capture.add(sent(grant_of(1)), kStart + 1s);
  capture.add(sent(peer::GrantRefusal{{}, 17}, true), kStart + 2s);
  capture.add(stated(kOurs, peer::version_of(2, 6)), kStart + 3s);
  EXPECT_THAT(run_reckon({"inspect", capture.path(), "owners"}).lines(),
              ElementsAre(HasSubstr("FROM"), HasSubstr("granted"), "1 change of owner"));
}

}  // namespace
}  // namespace reckon::tools
