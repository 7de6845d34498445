// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/verbs/given_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <net/if.h>

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "reckon/tools/command_line/file_kind.hpp"

namespace reckon::tools {
namespace {

/// The verb for a kind of file in `reckon FILE`.
struct Opening {
  FileKind kind;
  std::string_view name;
  std::vector<std::string> words;  ///< words before the file; none: no verb opens it directly
  std::string_view remedy = {};    ///< {0} is the file
};

const std::vector<Opening>& openings() {
  static const std::vector<Opening> kOpenings{
      {FileKind::capture, "a capture", {"inspect"}},
      {FileKind::scene, "a scene", {"demo"}},
      {FileKind::mesh, "a mesh", {"demo", "--mesh"}},
      {FileKind::key,
       "a key",
       {},
       "`reckon peer SCENE --key {0}` uses it, demo and inspect too; `reckon key show {0}` shows "
       "it"},
      {FileKind::table,
       "a table",
       {},
       "`reckon tune {0}` reads recorded motion, `reckon demo --hand {0}` the trace of a hand"},
      {FileKind::unknown,
       "not a capture, a scene (.toml) or a mesh (.obj, .ply, .stl, .off)",
       {},
       "put a verb before it; `reckon help` lists them"}};
  return kOpenings;
}

}  // namespace

std::optional<std::vector<std::string>> words_for_file(Arguments words, const Console& console) {
  const std::string file(words.front());
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored) && if_nametoindex(file.c_str()) != 0)
    throw UsageError(
        fmt::format("it is a network interface: `reckon inspect --iface {0}` shows "
                    "its traffic, `reckon peer SCENE --iface {0}` joins there",
                    file));
  if (!std::filesystem::exists(file, ignored) || std::filesystem::is_directory(file, ignored))
    return std::nullopt;
  const Opening& opening = *std::ranges::find(openings(), kind_of_file(file), &Opening::kind);
  if (opening.words.empty())
    throw UsageError(fmt::format("this file is {}: {}", opening.name,
                                 fmt::format(fmt::runtime(opening.remedy), file)));
  std::vector<std::string> all = opening.words;
  all.insert(all.end(), words.begin(), words.end());
  fmt::print(console.err, "{} is {}: reckon {}\n", file, opening.name, fmt::join(all, " "));
  return all;
}

}  // namespace reckon::tools
