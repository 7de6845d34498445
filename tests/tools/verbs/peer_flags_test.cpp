// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Every flag of `reckon peer`: its effect on a peer on loopback that another one observes, or its
// refusal by name.
#include <gmock/gmock.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "reckon/tests/support/places.hpp"
#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"

namespace reckon::tools {
namespace {

using test::ProgramResult;
using test::run_reckon;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using Words = std::vector<std::string>;
/// Facts about a run that hold however busy the machine is.
using Facts = std::set<std::string>;

// Two hands at rest above a wall.
constexpr const char* kScene = R"(
[scene]
name = "flags"
origin = {latitude = "47.05 deg", longitude = "8.31 deg", height = "430 m"}
[[object]]
name = "wall"
plane = [0.0, 0.0, 1.0]
surface = {stiffness = "800 N/m", damping = "0.2 N s/m"}
[[operator]]
passive = true
position = [0.0, 0.0, 0.05]
[[operator]]
passive = true
position = [0.1, 0.0, 0.05]
[aoim]
pool = 16
)";

/// The host name as in a marking: its first part, with room for a number.
std::string name_of_host() {
  char name[256] = {};
  gethostname(name, sizeof name - 1);
  return std::string(name).substr(0, std::string(name).find('.')).substr(0, 10);
}

/// A flag, and the fact that appears or disappears with it.
struct Change {
  std::string flag, value, fact;
  bool is_gained = true;
};

void add_summary(const nlohmann::json& row, Facts& facts) {
  facts.insert("prints one object");
  if (!row["remote_seen_s"].is_null()) facts.insert("hears somebody");
  if (row["seconds"].get<double>() >= 1.5) facts.insert("runs for 1.5 s");
  if (row["sent_position"].get<int>() > 0) facts.insert("moves");
  if (row.contains("leaders") && row["leaders"].is_object() && row["leaders"].contains("followed"))
    facts.insert("follows");
}

class PeerFlags : public testing::Test {
 protected:
  void SetUp() override {
    // Each test program of a parallel ctest run uses a port of its own.
    const std::string network =
        "[network]\ngroup = \"239.192.78.60\"\nport = " + std::to_string(20000 + getpid() % 20000) +
        "\n";
    std::ofstream(scene_) << kScene << network;
    std::ofstream(led_) << kScene << "leaders = true\nhand_out = true\n" << network;
    std::ofstream(corner_) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                              "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    ASSERT_EQ(run_reckon({"key", "new", key_}).status, 0);
  }

  /// Facts about a peer with these flags, observed by peer 2 of the same scene while it runs.
  [[nodiscard]] static Facts facts_of(const std::string& scene, const Words& flags) {
    std::atomic<bool> stop = false;
    ProgramResult seen;
    std::thread watcher([&] {
      seen = run_reckon({"peer", scene, "--iface", "lo", "--operator", "2", "--events"}, &stop);
    });
    Words words{"peer", scene, "--iface", "lo"};
    words.insert(words.end(), flags.begin(), flags.end());
    const ProgramResult result = run_reckon(words);
    stop = true;
    watcher.join();
    EXPECT_EQ(result.status, 0) << result.err << testing::PrintToString(words);

    Facts facts;
    if (result.err.find("this is peer") != std::string::npos) facts.insert("finds its number");
    if (result.err.find("page: http://127.0.0.1:") != std::string::npos)
      facts.insert("serves a page");
    if (result.err.find("metrics: http://127.0.0.1:") != std::string::npos)
      facts.insert("serves metrics");
    if (result.err.find("Falcon: ") != std::string::npos ||
        result.err.find("Polhem: ") != std::string::npos ||
        result.err.find("/dev/none: ") != std::string::npos)
      facts.insert("speaks of its device");
    for (const std::string& line : result.lines()) {
      const auto row = nlohmann::json::parse(line, nullptr, false);
      if (row.is_discarded()) {
        facts.insert("prints text");
      } else if (row.contains("event")) {
        facts.insert("tells " + row["event"].get<std::string>());
      } else {
        add_summary(row, facts);
      }
    }
    for (const std::string& line : seen.lines()) {
      const auto row = nlohmann::json::parse(line, nullptr, false);
      if (!row.is_discarded() && row["event"] == "appeared")
        facts.insert("is seen as " + row["marking"].get<std::string>());
    }
    return facts;
  }

  /// Replaces the mode's own value of the flag.
  [[nodiscard]] static Words with(Words mode, const std::string& flag, const std::string& value) {
    const auto own = std::ranges::find(mode, flag);
    if (own != mode.end()) {
      *(own + 1) = value;
      return mode;
    }
    mode.push_back(flag);
    if (!value.empty()) mode.push_back(value);
    return mode;
  }

  test::ScratchFolder folder_;
  std::string scene_ = folder_.file("flags.toml"), led_ = folder_.file("led.toml"),
              corner_ = folder_.file("corner.obj"), key_ = folder_.file("group.key"),
              log_ = folder_.file("notices.log"),
              trace_ = test::source_dir() + "/scenes/wall_trace.csv";
  const Words mode_{"--operator", "1", "--for", "1500ms", "--json"};
};

TEST_F(PeerFlags, EachChangeAnObservableFact) {
  const std::string host = "is seen as " + name_of_host();
  const Facts plain = facts_of(scene_, mode_);
  EXPECT_EQ(plain, (Facts{"hears somebody", host, "prints one object", "runs for 1.5 s"}));
  const std::vector<Change> changes{
      {"--name", "BOB", "is seen as BOB"},
      {"--for", "500ms", "runs for 1.5 s", false},
      {"--to", "127.0.0.1", host, false},
      {"--events", "", "tells appeared"},
      {"--felt", "", "tells felt"},
      {"--view", "", "serves a page"},
      {"--metrics", "0", "serves metrics"},
      {"--balance", "200ms", "tells balance"},
      {"--mesh", corner_, host, false},
      {"--hand", trace_, "moves"},
      {"--impair", "loss=100%", "hears somebody", false},
      {"--key", key_, host, false},
      {"--device", "falcon", "speaks of its device"},
      {"--device", "polhem", "speaks of its device"},
      {"--device", "/dev/none", "speaks of its device"},
  };
  for (const Change& change : changes) {
    const Facts facts = facts_of(scene_, with(mode_, change.flag, change.value));
    EXPECT_EQ(plain.contains(change.fact), !change.is_gained) << change.flag;
    EXPECT_EQ(facts.contains(change.fact), change.is_gained)
        << change.flag << ": " << testing::PrintToString(facts);
  }
  (void)facts_of(scene_, with(mode_, "--log", log_));
  EXPECT_NE(std::ifstream(log_).peek(), std::ifstream::traits_type::eof()) << "no notice in it";

  // Flags of the mode.
  EXPECT_THAT(facts_of(scene_, {"--operator", "1", "--for", "500ms"}), Contains("prints text"));
  EXPECT_THAT(facts_of(scene_, {"--for", "500ms", "--json"}), Contains("finds its number"));
  EXPECT_THAT(plain, Not(Contains("finds its number")));

  const Facts led = facts_of(led_, mode_),
              follower = facts_of(led_, with(mode_, "--follow", "gate"));
  EXPECT_THAT(led, Not(Contains("follows")));
  EXPECT_THAT(follower, Contains("follows"));

  // A flag missing in this list has no known effect. The test two_applications covers
  // --application, namespaces.join --join and --exercise, the viewer tests the page's flags,
  // NativeCode --plugin, StepTooDear --even-if-slow, and Pace --pace.
  Facts known{"SCENE",      "--help",         "--operator",    "--json",          "--follow",
              "--iface",    "--seed",         "--application", "--listen",        "--open",
              "--firmware", "--even-if-slow", "--tls",         "--behind-tunnel", "--plugin",
              "--log",      "--pace",         "--join",        "--exercise"};
  for (const Change& change : changes) known.insert(change.flag);
  for (const std::string& flag : test::flags_of({"peer"})) EXPECT_THAT(known, Contains(flag));
}

// A useless flag is refused before anything starts.
TEST_F(PeerFlags, AreRefusedByNameWhereUseless) {
  const std::vector<Words> refused{
      {"--follow", "gate"},  // no groups are handed out
      {"--seed", "7"},       // nothing is drawn; a simulated demo shows its effect
      {"--pace", "2"},       // there are no bodies
      {"--iface", "no-such-interface"},
      {"--operator", "0"},
      {"--application", "2"},   // peers agree on their IDs
      {"--listen", "0.0.0.0"},  // there is no page
      {"--tls", "a.crt", "a.key"},
      {"--behind-tunnel"},
      {"--listen", "0.0.0.0", "--view=0", "--key", key_},  // unencrypted
      {"--tls", "a.crt", "a.key", "--view=0"},             // there is no such file
      {"--plugin", folder_.file("none.so")},
      {"--metrics", "crane"},   // no port
      {"--device", "crane"},    // no such driver
      {"--firmware", corner_},  // no firmware of a device
      {"--join"},               // the scene is given
      {"--exercise", "5"},      // the scene has it
  };
  for (const Words& flag : refused) {
    Words words{"peer", scene_, "--for", "10ms"};
    words.insert(words.end(), flag.begin(), flag.end());
    const ProgramResult result = run_reckon(words);
    EXPECT_NE(result.status, 0) << flag[0];
    EXPECT_TRUE(result.out.empty()) << flag[0];
    EXPECT_THAT(result.err, HasSubstr(flag[0] == "--iface" ? flag[1] : flag[0]));
  }
  const ProgramResult unnumbered = run_reckon({"peer", scene_, "--iface", "lo", "--balance", "1s"});
  EXPECT_EQ(unnumbered.status, 2);
  EXPECT_THAT(unnumbered.err, HasSubstr("--operator 1"));

  std::ofstream(scene_, std::ios::app) << "interop = true\n";
  for (const char* number : {"0", "65535"}) {
    const ProgramResult none =
        run_reckon({"peer", scene_, "--iface", "lo", "--for", "10ms", "--application", number});
    EXPECT_EQ(none.status, 2);
    EXPECT_THAT(none.err, HasSubstr("1 to 65534"));
  }
}

}  // namespace
}  // namespace reckon::tools
