// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene/renamed_keys.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <string>

#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/scene/scene_keys.hpp"
#include "reckon/tests/src/support/refusal.hpp"
#include "reckon/tests/support/tier_rows.hpp"

namespace reckon::peer {
namespace {

using test::refusal;
using testing::HasSubstr;
using testing::Not;

const std::string kUsualRows = R"([[aoim.tier]]
farthest = "1 m"
active = "1 kHz"
passive = "1 kHz"
octets = "232 B"
kept = true
[[aoim.tier]]
farthest = "50 m"
active = "30 Hz"
passive = "0.2 Hz"
octets = "232 B"
[[aoim.tier]]
farthest = "200 m"
body = "approximate"
active = "10 Hz"
passive = "0.2 Hz"
octets = "176 B"
coarser = 4
[[aoim.tier]]
body = "rigid"
active = "1 Hz"
passive = "0.2 Hz"
octets = "144 B"
coarser = 16)";

/// The lines that a refusal suggests: from its first [[aoim.tier]] row to the next problem.
std::string pasted(const std::string& refusal) {
  const std::size_t begin = refusal.find("\n[[aoim.tier]]\n") + 1;
  return refusal.substr(begin, refusal.find("\nx.toml:", begin) - begin);
}

TEST(RenamedKeys, AreRefusedAtTheirPlace) {
  for (const RenamedKey& one : renamed_keys()) {
    EXPECT_TRUE(std::ranges::none_of(scene_keys(), [&](const SceneKey& key) {
      return key.section == one.section && key.key == one.key;
    })) << one.key;
    for (const char* value : {"true", "false", "7", "[{farthest = 1}]", "[3, {}]"}) {
      const std::string said = refusal(fmt::format("[{}]\n{} = {}\n", one.section, one.key, value));
      EXPECT_THAT(said, HasSubstr(fmt::format("x.toml:2:1: '{}' ", one.key))) << value;
      EXPECT_THAT(said, Not(HasSubstr("unknown key"))) << value;
    }
  }
}

TEST(RenamedKeys, OfChannelsGiveTheUsualRows) {
  const std::string said = refusal("[aoim]\nchannels = true\nradius = 5\n");
  EXPECT_EQ(said,
            "x.toml:2:1: 'channels' is now rows of [[aoim.tier]]: remove the line and write, after "
            "the other keys of [aoim]:\n" +
                kUsualRows);
  EXPECT_EQ(parse_scene_file(pasted(said), "x").hash,
            parse_scene_file("[aoim]\n" + test::kDistanceTiers, "x").hash);
}

TEST(RenamedKeys, ChannelRowsMapToTheSameTiers) {
  const std::string rows =
      "[[aoim.channel]]\nfarthest = \"2 m\"\nactive = 9\noctets = 144\nkept = true\n"
      "[[aoim.channel]]\nfarthest = \"3 m\"\nbody = \"full\"\nactive = 9\noctets = 144\n"
      "[[aoim.channel]]\nactive = 9\noctets = 144\n";
  const std::string expected =
      "[[aoim.tier]]\nfarthest = \"2 m\"\nactive = 9\noctets = 144\nkept = true\n"
      "[[aoim.tier]]\nfarthest = \"3 m\"\nbody = \"full\"\nactive = 9\noctets = 144\n{}"
      "[[aoim.tier]]\nactive = 9\noctets = 144";
  const std::string plain = refusal("[aoim]\nchannels = true\n" + rows);
  EXPECT_THAT(
      plain,
      HasSubstr("x.toml:2:1: 'channels' was replaced by rows of [[aoim.tier]]: remove the line"));
  EXPECT_THAT(plain, HasSubstr("'channel' is 'tier' now: write in place of all its rows:"));
  EXPECT_EQ(pasted(plain), fmt::format(fmt::runtime(expected), ""));
  const std::string near = refusal("[aoim]\nchannels = true\nnear_groups = true\n" + rows);
  EXPECT_EQ(pasted(near), fmt::format(fmt::runtime(expected), "own_group = true\n"));
  EXPECT_EQ(parse_scene_file(pasted(near), "x").aoim.all_groups(), 512u);
}

TEST(RenamedKeys, OfGroupsGiveARowAndAKey) {
  EXPECT_EQ(refusal("[aoim]\ncontact_groups = true\n"),
            "x.toml:2:1: 'contact_groups' is now a tier: remove the line and write, after the "
            "other keys of [aoim], before any other [[aoim.tier]]:\n[[aoim.tier]]\nto = \"touch\"");
  EXPECT_EQ(refusal("[aoim]\nnear_groups = true\n"),
            "x.toml:2:1: 'near_groups' is now a key of tiers: remove the line and write in each "
            "[[aoim.tier]] by distance that is neither 'kept' nor the last:\nown_group = true");
  const std::string both = pasted(refusal("[aoim]\nnear_groups = true\nchannels = true\n"));
  EXPECT_EQ(parse_scene_file(both, "x").hash,
            parse_scene_file("[aoim]\n" + test::kOwnTiers, "x").hash);
}

TEST(RenamedKeys, ThatAreOffAreTakenOut) {
  EXPECT_EQ(refusal("[aoim]\ncontact_groups = false\n"),
            "x.toml:2:1: 'contact_groups' is now a tier: remove the line");
}

}  // namespace
}  // namespace reckon::peer
