// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The error texts of wrong usage: the value at fault, and the remedy.
#include <gmock/gmock.h>

#include <ostream>

#include "reckon/tests/support/places.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"

namespace reckon::tools {
namespace {

struct Mistake {
  std::vector<std::string> words;
  std::string fault;   ///< the named fault
  std::string remedy;  ///< the named remedy
};

void PrintTo(const Mistake& mistake, std::ostream* out) {
  for (const std::string& word : mistake.words) *out << word << ' ';
}

class ErrorText : public testing::TestWithParam<Mistake> {};

TEST_P(ErrorText, NamesFaultAndRemedyOnStderrOnly) {
  const auto result = test::run_reckon(GetParam().words);
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, testing::StartsWith("reckon"));
  EXPECT_THAT(result.err, testing::HasSubstr(GetParam().fault));
  EXPECT_THAT(result.err, testing::HasSubstr(GetParam().remedy));
}

const Mistake kMistakes[] = {
    {{"inspetc"}, "no verb 'inspetc'", "did you mean 'inspect'?"},
    {{"help", "zzz"}, "no verb 'zzz'", "`reckon --help` lists"},
    {{"--hlep"}, "no flag '--hlep'", "did you mean '--help'?"},
    {{"help", "inspect", "b"}, "unexpected argument 'b'", "write reckon help [VERB]"},
    {{"inspect", "/no/file.pcap"},
     "/no/file.pcap cannot be opened: No such file",
     "give a pcap or pcapng file"},
    {{"inspect", "/tmp"}, "/tmp is a folder", "name a capture file in it"},
    {{"inspect", "raw:/no/file"}, "/no/file", "needs a file of one bare datagram"},
    {{"inspect", "raw:"}, "'raw:' has no name", "write raw:FILE"},
    {{"inspect", "iface:"}, "'iface:' has no name", "for example iface:eth0"},
    {{"inspect", "http://x"}, "no source 'http://'", "write udp://ADDRESS"},
    {{"inspect", "/no/scene.toml"}, "/no/scene.toml: there is no such file", "name a scene file"},
    {{"inspect", "udp://x"}, "'udp://x' is not an address", "write udp://239"},
    {{"inspect", "lo"}, "no file 'lo'", "did you mean --iface lo"},
    {{"record", "x.pcapng", "239.1.2.3:3000"}, "'239.1.2.3:3000'", "udp://239.1.2.3:3000"},
    {{"inspect", "239.1.2.3:3000"},
     "no file '239.1.2.3:3000'",
     "did you mean udp://239.1.2.3:3000?"},
    {{"inspect", "a.pcap", "--iface", "lo"}, "not for 'a.pcap'", "remove them"},
    {{"inspect", "a.pcap", "stat"}, "VIEW: 'stat'", "did you mean 'stats'?"},
    {{"inspect", "a.pcap", "stats", "--by", "tpye"}, "--by: 'tpye'", "did you mean 'type'?"},
    {{"inspect", "--cuont", "3", "a.pcap"}, "no flag '--cuont'", "did you mean '--count'?"},
    {{"inspect", "a.pcap", "--count", "3x"}, "--count: '3x'", "whole number of at least 0"},
    {{"inspect", "a.pcap", "--for", "10sec"}, "--for: '10sec'", "as in 10s"},
    {{"inspect", "a.pcap", "--for"}, "--for needs a value after it", "after it: DURATION"},
    {{"inspect", "a.pcap", "--where", "knd == 1"}, "column 1", "did you mean 'kind'?"},
    {{"scene"}, "write an action", "reckon scene check"},
    {{"scene", "chekc"}, "ACTION: 'chekc'", "did you mean 'check'?"},
    {{"scene", "explain"}, "name a scene file", "reckon scene explain FILE"},
    {{"demo", "--peers", "65"}, "65 peers", "choose 1 to 64"},
    {{"demo", "--mesh", "missing.ply"}, "--mesh: there is no file 'missing.ply'", "OBJ, PLY, STL"},
    {{"demo", "--hand", "missing.csv"}, "--hand: there is no file 'missing.csv'", "for example"},
    {{"peer", test::source_dir() + "/scenes/two_hands.toml", "--operator", "7"},
     "--operator 7: the peers of this scene have the numbers 1 to 2",
     "write one of them"},
    {{"demo", "--impair", "dealy=2ms"}, "'dealy'", "did you mean 'delay'?"},
    {{"demo", "a", "b"}, "unexpected argument 'b'", "write reckon demo [SCENE]"},
    {{"peer"}, "SCENE is required", "write reckon peer SCENE"},
    {{"peer", "a.toml", "--name", "TWELVE_CHARS"},
     "'TWELVE_CHARS' has 12 characters",
     "at most 11"},
    {{"peer", "a.toml", "--to", "host-b:0"},
     "--to: 'host-b:0' has a port",
     "write addresses or names"},
    {{"peer", "a.toml", "--to", "10.0.0.7,,b"}, "has no host", "separated by commas"},
    {{"peer", "a.toml", "--balance", "1ms"}, "--balance: write at least", "at least 100ms"},
    {{"peer", test::source_dir() + "/scenes/two_hands.toml", "--balance", "1s"},
     "--balance needs the number of this peer",
     "for example --operator 1"},
    {{"peer", "/no/file.toml"}, "/no/file.toml: there is no such file", "name a scene file"},
    {{"scene", "keys", "more"}, "unexpected argument 'more'", "write reckon scene keys"},
    {{"demo", "--for", "10"}, "--for: '10'", "as in 10s"},
    {{"demo", "--impair", "loss=200%"}, "loss = 2 is not a share", "0% to 100%"},
    {{"inspect", "a.pcap", "--by", "type"}, "--by needs the view stats", "SOURCE stats --by"},
    {{"inspect", "a.pcap", "stats", "--csv", "--json"}, "are alternatives", "remove one of them"},
    {{"doctor", "extra"}, "extra: there is no such file", "name a scene file"},
    {{"doctor", "--groups", "x"}, "--groups: 'x'", "whole number"},
    {{"completion"}, "name a shell", "reckon completion bash"},
    {{"completion", "bahs"}, "SHELL: 'bahs'", "did you mean 'bash'?"},
};

INSTANTIATE_TEST_SUITE_P(Mistakes, ErrorText, testing::ValuesIn(kMistakes));

}  // namespace
}  // namespace reckon::tools
