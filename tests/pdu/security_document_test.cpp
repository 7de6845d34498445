// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// docs/security.md lists each PDU and record with its permitted sender, the gain of a forger and
// its bounds: each new one needs its row.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/pdu/pdu_types.hpp"
#include "reckon/pdu/type_names.hpp"
#include "reckon/tests/support/places.hpp"

namespace reckon::pdu {
namespace {

std::string source_text(const std::filesystem::path& path) {
  std::ifstream file(std::filesystem::path(reckon::test::source_dir()) / path);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> split(const std::string& text, const std::string& by) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find(by, begin)) != std::string::npos; begin = end + by.size())
    parts.push_back(text.substr(begin, end - begin));
  parts.push_back(text.substr(begin));
  return parts;
}

/// Names in the first cells of the whole rows of its table.
std::set<std::string> documented() {
  std::set<std::string> names;
  std::istringstream text(source_text("docs/security.md"));
  bool within = false;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("## ")) within = line.starts_with("## Each PDU");
    if (!within || !line.starts_with("| ") || !line.ends_with(" |")) continue;
    const auto cells = split(line.substr(2, line.size() - 4), " | ");
    if (cells.size() != 4) continue;
    for (const std::string& name : split(cells[0], ", ")) names.insert(name);
  }
  return names;
}

/// `text` must outlive the matches.
std::vector<std::smatch> matches(const std::string& text, const std::regex& pattern) {
  return {std::sregex_iterator(text.begin(), text.end(), pattern), std::sregex_iterator()};
}

/// "name = number" of an enumeration, as "prefix number name" with spaces.
std::set<std::string> enumerators(const std::string& type, const std::string& prefix) {
  const std::string header = source_text("pdu/codec/enumerations.hpp");
  const std::size_t begin = header.find("enum class " + type + " ");
  EXPECT_NE(begin, std::string::npos) << type;
  const std::string body = header.substr(begin, header.find("};", begin) - begin);
  std::set<std::string> names;
  for (const std::smatch& match : matches(body, std::regex(R"((\w+) = (\d+))"))) {
    std::string name = match[1].str();
    for (char& letter : name) letter = letter == '_' ? ' ' : letter;
    names.insert(prefix + " " + match[2].str() + " " + name);
  }
  EXPECT_GE(names.size(), 3U) << type;
  return names;
}

template <typename... T>
void expect_rows(const std::set<std::string>& rows, TypeList<T...>) {
  for (const PduType type : {T::kPduType...}) {
    const std::string row = std::to_string(static_cast<int>(type)) + " " + std::string(name(type));
    EXPECT_TRUE(rows.contains(row)) << "docs/security.md has no row for PDU " << row;
  }
}

TEST(SecurityDocument, HasARowForEachPduType) { expect_rows(documented(), PduTypes{}); }

TEST(SecurityDocument, HasARowForEachRecordOfOurs) {
  const auto rows = documented();
  const std::regex record(R"(k(\w+)RecordType = (0x[0-9A-F]+);)");
  std::size_t found = 0;
  const auto folder = std::filesystem::path(reckon::test::source_dir()) / "pdu/reckon";
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    const std::string header = source_text(file.path());
    for (const std::smatch& match : matches(header, record)) {
      ++found;
      const bool named = std::any_of(rows.begin(), rows.end(), [&](const std::string& row) {
        return row.starts_with("record " + match[2].str() + " ");
      });
      EXPECT_TRUE(named) << "docs/security.md has no row for record " << match[2] << " ("
                         << match[1] << ")";
    }
  }
  EXPECT_GE(found, 2U);
}

TEST(SecurityDocument, HasARowForEachFormAndParameter) {
  const auto rows = documented();
  std::set<std::string> wanted = enumerators("CompressedForm", "form");
  wanted.erase("form 0 none");
  wanted.merge(enumerators("VariableParameterType", "variable parameter"));
  for (const std::string& row : wanted)
    EXPECT_TRUE(rows.contains(row)) << "docs/security.md has no row for " << row;
}

}  // namespace
}  // namespace reckon::pdu
