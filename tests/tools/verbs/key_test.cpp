// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Key files by command, and the inspector's output for sealed datagrams with a key and without.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "reckon/peer/sealing/envelope_sealer.hpp"
#include "reckon/tests/tools/support/capture_verbs.hpp"

namespace reckon::tools::captures {
namespace {

using testing::HasSubstr;
using testing::Not;

class KeyVerb : public testing::Test {
 protected:
  KeyVerb() { EXPECT_EQ(run_reckon({"key", "new", key(), "--group", "crane"}).status, 0); }
  [[nodiscard]] std::string key() const { return folder_.file("g.key"); }

  /// 3 datagrams of two Entity States each, sealed, and a greeting.
  [[nodiscard]] std::string sealed_capture() const {
    const peer::GroupKey loaded = peer::load_group_key(key());
    peer::EnvelopeSealer sealer(loaded, 7, 8, {5, {}});  // an exercise missing in the capture
    Octets plain = entity_state(1);
    append(plain, pdu::EntityState{});
    peer::CaptureWriter writer({.path = folder_.file("sealed.pcapng")});
    for (int i = 0; i < 4; ++i) {
      const auto stream = i < 3 ? peer::SealingStream::datagrams : peer::SealingStream::control;
      Octets room(plain.size() + peer::kEnvelope);
      peer::SourceDatagram datagram;
      datagram.source = peer::IpEndpoint::v4(0x0a000001, 4000);
      datagram.group = group(0);
      datagram.bytes = sealer.seal(stream, 0, group(0), std::chrono::seconds(1), plain, room);
      writer.write(datagram);
    }
    writer.finish(4, 0);
    return folder_.file("sealed.pcapng");
  }

  ScratchFolder folder_;
};

TEST_F(KeyVerb, MakesOwnerOnlyFilesAndShowsNoSecret) {
  struct stat state {};
  ASSERT_EQ(::stat(key().c_str(), &state), 0);
  EXPECT_EQ(state.st_mode & 07777, 0600U);
  std::ifstream file(key());
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::string secret = text.substr(text.find("secret ") + 7, 64);
  const ProgramResult shown = run_reckon({"key", "show", key()});
  EXPECT_EQ(shown.status, 0);
  EXPECT_THAT(shown.out, HasSubstr("group  crane"));
  EXPECT_THAT(shown.out, Not(HasSubstr(secret.substr(0, 12))));
}

TEST_F(KeyVerb, AddsTheSecretOfALaterTime) {
  const ProgramResult added = run_reckon({"key", "next", key(), "--from", "2090-01-01T00:00:00Z"});
  EXPECT_EQ(added.status, 0) << added.err;
  EXPECT_THAT(run_reckon({"key", "show", key()}).out,
              HasSubstr("epoch  2  from 2090-01-01T00:00:00Z"));
  const ProgramResult before = run_reckon({"key", "next", key(), "--from", "2089-01-01T00:00:00Z"});
  EXPECT_EQ(before.status, 2);
  EXPECT_THAT(before.err, HasSubstr("must increase"));
}

TEST_F(KeyVerb, RefusesANextEpochInThePast) {
  const ProgramResult past = run_reckon({"key", "next", key(), "--from", "1970-01-01T00:00:00Z"});
  EXPECT_EQ(past.status, 2);
  EXPECT_THAT(past.err, HasSubstr("--from 1970-01-01T00:00:00Z is past"));
  EXPECT_THAT(run_reckon({"key", "show", key()}).out, Not(HasSubstr("epoch  2")));
}

TEST_F(KeyVerb, EndsWithStatus2ForAnUnusableKey) {
  EXPECT_EQ(run_reckon({"key", "new", key()}).status, 2);
  const std::string capture = sealed_capture();
  ASSERT_EQ(::chmod(key().c_str(), 0644), 0);
  const std::vector<std::vector<std::string>> lines = {
      {"demo", "--simulated-time", "--for", "1s", "--key", key()},
      {"inspect", capture, "--key", key()},
      {"record", folder_.file("live.pcapng"), "--iface", "lo", "--for", "1s", "--key", key()},
      {"replay", capture, "--key", key()}};
  for (const std::vector<std::string>& line : lines) {
    const ProgramResult refused = run_reckon(line);
    EXPECT_EQ(refused.status, 2) << line.front();
    EXPECT_THAT(refused.err, HasSubstr("chmod 600 " + key())) << line.front();
  }
}

TEST_F(KeyVerb, ReplaySendsSealedDatagramsAsPlainWithKey) {
  const std::string capture = sealed_capture();
  const std::vector<std::string> line = {"replay", capture, "--rate",
                                         "0",      "--to",  "udp://127.0.0.1:39999"};
  const ProgramResult sealed = run_reckon(line);
  EXPECT_THAT(sealed.err, HasSubstr("replayed 4 datagrams")) << "as they are";
  EXPECT_THAT(sealed.err, HasSubstr("sealed: 4 datagrams of 7:8"));
  std::vector<std::string> with_key = line;
  with_key.insert(with_key.end(), {"--key", key(), "--json"});
  const ProgramResult plain = run_reckon(with_key);
  EXPECT_EQ(plain.status, 0) << plain.err;
  EXPECT_THAT(plain.err, HasSubstr("replayed 3 datagrams")) << "greetings are no DIS";
  EXPECT_THAT(plain.out, HasSubstr("\"octets\":864")) << "six Entity States";
}

TEST_F(KeyVerb, InspectorReadsSealedDatagrams) {
  const ProgramResult read = run_reckon({"inspect", sealed_capture(), "--key", key(), "--json"});
  EXPECT_EQ(read.status, 0) << read.err;
  EXPECT_EQ(read.lines().size(), 6U);
  EXPECT_THAT(read.out, HasSubstr("entity_state"));
  EXPECT_THAT(read.err, HasSubstr("sealed: 4 datagrams of 7:8"));
  EXPECT_THAT(read.err, HasSubstr("epoch 1, 1 greeting"));
}

TEST_F(KeyVerb, InspectorReportsSealedDatagramsWithoutTheKey) {
  const std::string capture = sealed_capture();
  const ProgramResult read = run_reckon({"inspect", capture, "--json"});
  EXPECT_EQ(read.status, 1);
  EXPECT_EQ(read.out, "");
  EXPECT_THAT(read.err, HasSubstr("sealed: 4 datagrams of 7:8"));
  EXPECT_THAT(read.err, HasSubstr("add --key FILE"));
  EXPECT_EQ(run_reckon({"key", "new", folder_.file("other.key")}).status, 0);
  const ProgramResult other = run_reckon({"inspect", capture, "--key", folder_.file("other.key")});
  EXPECT_EQ(other.status, 1);
  EXPECT_THAT(other.err, HasSubstr("4 not readable with this key"));
}

}  // namespace
}  // namespace reckon::tools::captures
