// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Inputs like those of public bug reports, with the answers from an independent packer. The
// sentences of a check are tested beside its rule, with generated inputs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "reckon/tests/support/reference_data.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"

namespace reckon::tools {
namespace {

using testing::HasSubstr;
using testing::Not;

struct Question {
  std::string file;
  std::vector<std::string> words;  ///< of `reckon inspect FILE`; another verb begins with "!"
  std::vector<std::string> wanted, unwanted;
};

const std::vector<Question> kQuestions{
    {"f01-signal-13bits-bundle.pcap", {}, {"data_length 13", "     1   2     36", "AFTER"}, {}},
    {"f03-signal-database-index.pcap", {"--tree"}, {"class 3", "data_length 96"}, {}},
    {"f03b-signal-raw-binary.pcap", {"--tree"}, {"class 1", "Link 16", "data_length 200"}, {}},
    {"f05-ua-two-systems.pcap", {"--tree"}, {"6001", "6002", "-3"}, {}},
    {"f06-ee-zero-beams.pcap", {"emissions"}, {"no beam", "2 beams", "1 beam"}, {}},
    {"f07-fire-dis6-padding.pcap", {}, {"3 good, 0 errors"}, {}},
    {"f09-entity-state-140.pcap", {}, {"E-LENGTH", "SECOND"}, {}},
    {"f10-places.pcap", {"check"}, {"5 x W-LOCATION"}, {}},
    {"f11-little-endian.pcap", {"check"}, {"octets swapped"}, {"tcpdump -s 0"}},
    {"f12a-timestamp-zero.pcap", {"check"}, {"not advance"}, {"NTP"}},
    {"f12b-absolute-hour-rollover.pcap", {"check"}, {"0 errors, 0 warnings"}, {}},
    {"f13a-spin-through-pi.pcap", {"check"}, {"0 errors, 0 warnings"}, {}},
    {"f15-count-0-records-2.pcap", {"check"}, {"W-TRAILING", "32 octets"}, {}},
    {"f16-orientation-degrees.pcap", {"check"}, {"W-ORIENTATION", "degrees"}, {}},
    {"f19-signal-unpadded-bundle.pcap", {}, {"     1   2     37", "AFTER"}, {}},
    {"f20-markings.pcap", {}, {"ELEVENCHARS"}, {"\x1b"}},
    {"f22-datums-odd-lengths.pcap", {"check"}, {"E-RECORD", "W-TRAILING", "14 octets"}, {}},
    {"f24-heartbeats.pcap", {"check"}, {"0 errors, 0 warnings"}, {}},
    {"f25-two-exercises.pcap", {"check"}, {"0 errors, 0 warnings"}, {}},
    {"f26-each-frame-twice.pcap", {"check"}, {"I-COPIES"}, {}},
    {"f28-velocity-local-frame.pcap", {"check"}, {"W-VELOCITY", "axes"}, {}},
    {"f31-bridge-loop.pcap", {"check"}, {"1 x W-DUPLICATE-ID"}, {}},
    {"f33-frozen.pcap", {"check"}, {"0 errors, 0 warnings"}, {}},
    {"g01-sll2.pcap", {}, {"3 good"}, {}},
    {"g02-null-le.pcap", {}, {"3 good"}, {}},
    {"g04-modified.pcap", {}, {"3 good"}, {}},
    {"g05-qinq-priority.pcap", {}, {"3 good"}, {}},
    {"g07-fcs-and-padding.pcap", {}, {"3 good"}, {}},
    {"g06-tunnels-vxlan-erspan-ipip.pcap", {}, {"3 good"}, {}},
    {"g09-wifi-radiotap.pcap", {}, {"IEEE802_11_RADIO"}, {}},
    {"g11-pcapng-resolutions.pcapng", {"!info"}, {"2023-"}, {"1970"}},
    {"g14-udp-length-lies.pcap", {}, {"L2"}, {}},
    {"g15-first-frame-later.pcap", {"!replay", "--rate", "0"}, {"replayed 6 datagrams"}, {}},
    {"r1-opendis7-listener.pcap", {"--lenient"}, {"1 error, 71 notes"}, {"says 0 octets"}},
};

TEST(FieldFiles, GiveTheRightAnswers) {
  RECKON_NEED_DATA("field/README.tsv");
  for (const Question& question : kQuestions) {
    const auto path = test::reference_data() / "field" / question.file;
    SCOPED_TRACE(question.file);
    ASSERT_TRUE(std::filesystem::exists(path));
    std::vector<std::string> words{"inspect", path.string()};
    for (const std::string& word : question.words) {
      if (word.starts_with('!'))
        words[0] = word.substr(1);
      else
        words.push_back(word);
    }
    const test::ProgramResult result = test::run_reckon(words);
    const std::string all = result.out + result.err;
    for (const std::string& text : question.wanted) EXPECT_THAT(all, HasSubstr(text));
    for (const std::string& text : question.unwanted) EXPECT_THAT(all, Not(HasSubstr(text)));
  }
}

TEST(FieldFiles, MeshesAreReadByTheirCounts) {
  RECKON_NEED_DATA("field/mesh");
  const std::pair<const char*, std::vector<std::string>> cases[]{
      {"solid.toml", {"12 triangles", "closed"}},
      {"solid_extra.toml", {"12 triangles", "closed", "2 octets"}},
      {"inverted.toml", {"turned outwards"}}};
  for (const auto& [name, wanted] : cases) {
    SCOPED_TRACE(name);
    const auto path = test::reference_data() / "field/mesh" / name;
    const test::ProgramResult result = test::run_reckon({"scene", "check", path.string()});
    for (const std::string& text : wanted) EXPECT_THAT(result.out + result.err, HasSubstr(text));
  }
}

}  // namespace
}  // namespace reckon::tools
