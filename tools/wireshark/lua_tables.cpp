// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Writes the tables of the Wireshark plug-in reckon.lua from the field tables, so that no field is
// listed twice by hand. `reckon_lua_tables FILE` prints the plug-in with new tables.
// `reckon_lua_tables --check FILE` compares its tables with the field tables (exit 1: they differ).
#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include "reckon/pdu/type_names.hpp"
#include "reckon/tools/wireshark/field_layout.hpp"

namespace reckon::tools {
namespace {

constexpr std::string_view kBegin = "-- BEGIN of the tables that reckon_lua_tables writes\n";
constexpr std::string_view kEnd = "-- END of the tables\n";
constexpr std::size_t kMostColumns = 97;  // the closing brace follows

/// A Lua table of many items, broken into lines.
std::string wrapped(const std::vector<std::string>& items, std::string_view indent) {
  std::string text;
  std::size_t column = kMostColumns;
  for (const std::string& item : items) {
    if (column + item.size() + 2 > kMostColumns) {
      text += fmt::format("\n{}", indent);
      column = indent.size();
    }
    text += item + ", ";
    column += item.size() + 2;
  }
  std::string lines;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text.compare(i, 2, " \n") != 0) lines += text[i];
  if (!lines.empty()) lines.pop_back();
  return lines;
}

bool has_floats(const std::vector<FieldPlace>& fields) {
  return std::ranges::any_of(fields, [](const FieldPlace& f) { return f.type.front() == 'f'; });
}

/// Fields to check for NaN and infinity: a sequence of {offset, octets, name}.
std::string floats_of(const std::vector<FieldPlace>& fields, std::string_view indent) {
  if (!has_floats(fields)) return "{}";
  std::vector<std::string> items;
  for (const FieldPlace& field : fields) {
    if (field.type.front() != 'f') continue;
    items.push_back(fmt::format("{}, {}, \"{}\"", field.offset, field.size, field.path));
  }
  return "{" + wrapped(items, indent) + " }";
}

std::string block_text(const BlockPlace& block) {
  std::string text = fmt::format("\n      {{ kind = \"{}\", name = \"{}\"", block.kind, block.name);
  if (block.count.size > 0)
    text += fmt::format(",\n        at = {}, width = {}, count = \"{}\"", block.count.offset,
                        block.count.size, block.count.path);
  if (block.size > 0) text += fmt::format(", size = {}", block.size);
  if (has_floats(block.fields))
    text += fmt::format(",\n        floats = {}", floats_of(block.fields, "          "));
  return text + " },";
}

/// Checks of a PDU: least length, place of its entity, variable parts, floats.
template <typename T>
std::string pdu_text() {
  const FieldLayout layout = layout_of<T>();
  std::string text = fmt::format("  [{}] = {{ name = \"{}\", family = {}, size = {}",
                                 static_cast<unsigned>(T::kPduType), pdu::snake_name(T::kPduType),
                                 static_cast<unsigned>(T::kProtocolFamily), layout.size());
  if (layout.id_at().has_value()) text += fmt::format(", id = {}", *layout.id_at());
  text += fmt::format(",\n    floats = {},\n    blocks = {{", floats_of(layout.places(), "      "));
  for (const BlockPlace& block : layout.blocks()) text += block_text(block);
  return text + (layout.blocks().empty() ? "} },\n" : "\n    } },\n");
}

template <typename... T>
std::string pdus_text(pdu::TypeList<T...>) {
  std::vector<std::pair<pdu::PduType, std::string>> rows{{T::kPduType, pdu_text<T>()}...};
  std::ranges::sort(rows);
  std::string text = "local PDUS = {\n";
  for (const auto& row : rows) text += row.second;
  return text + "}\n";
}

std::string field_text(const FieldPlace& field, std::size_t skipped) {
  std::string text = fmt::format("    {{ \"{}\", {}, {}, \"{}\"", field.path.substr(skipped),
                                 field.offset, field.size, field.type);
  if (field.is_pdu_type) text += ", PDU_NAMES";
  if (!field.names.empty()) {
    std::vector<std::string> items;
    for (const auto& [value, name] : field.names)
      items.push_back(fmt::format("[{}] = \"{}\"", value, name));
    text += ", {" + wrapped(items, "      ") + " }";
  }
  return text + " },\n";
}

/// All fields of one of our own records or PDUs, without a PDU's header.
template <typename T>
std::string own_text(std::string_view key) {
  const FieldLayout layout = layout_of<T>();
  std::string text = fmt::format("  {} = {{ size = {}", key, layout.size());
  if constexpr (requires { T::kType; }) text += fmt::format(", type = {:#x}", T::kType);
  if constexpr (requires { T::kVersion; }) text += fmt::format(", version = {}", T::kVersion);
  text += ", fields = {\n";
  for (const FieldPlace& field : layout.places())
    if (!field.path.starts_with("header.")) text += field_text(field, 0);
  return text + "  } },\n";
}

std::string names_text() {
  std::string text = "local PDU_NAMES = {}\n";
  return text + "for number, pdu in pairs(PDUS) do PDU_NAMES[number] = pdu.name end\n";
}

std::string rules_text() {
  std::string text = "local RULES = {\n";
  for (std::size_t i = 1; i < pdu::kDecodeErrors; ++i) {
    const auto error = static_cast<pdu::DecodeError>(i);
    text += fmt::format("  [\"{}\"] = \"{}\",\n", pdu::rule(error), pdu::sentence(error));
  }
  return text + "}\n";
}

std::string tables() {
  return fmt::format("local OLDEST_VERSION, NEWEST_VERSION, HEADER_SIZE = {}, {}, {}\n",
                     pdu::kOldestProtocolVersion, pdu::kProtocolVersion, pdu::kHeaderSize) +
         rules_text() + pdus_text(pdu::PduTypes{}) + names_text() + "local OWN = {\n" +
         own_text<pdu::PduHeader>("header") + own_text<pdu::Attribute>("attribute") +
         own_text<pdu::HapticRecord>("haptic") + own_text<pdu::EnergyAccountRecord>("energy") +
         own_text<pdu::OwnershipRecord>("ownership") + own_text<pdu::Presence>("presence") +
         own_text<pdu::DatagramTrailer>("trailer") + own_text<pdu::CellMembership>("membership") +
         own_text<pdu::CellIndex>("cell") + own_text<pdu::TimeExchange>("exchange") +
         own_text<pdu::TimeEcho>("echo") + own_text<pdu::PeersHeard>("heard") +
         own_text<pdu::PeerEpoch>("peer") + own_text<pdu::CellRoles>("roles") +
         own_text<pdu::CellRole>("role") + own_text<pdu::GroupMap>("group_map") +
         own_text<pdu::CellGroup>("cell_group") + own_text<pdu::CellSnapshot>("snapshot") +
         own_text<pdu::CompressedStates>("compressed") + own_text<pdu::UnicastFrame>("unicast") +
         own_text<pdu::AssuredRecord>("assured") + "}\n";
}

/// The plug-in with new tables; empty if it has no place for them.
std::string renewed(const std::string& plugin) {
  const std::size_t begin = plugin.find(kBegin);
  const std::size_t end = plugin.find(kEnd);
  if (begin == std::string::npos || end == std::string::npos || end < begin) return {};
  return plugin.substr(0, begin + kBegin.size()) + tables() + plugin.substr(end);
}

int run(bool check, const char* path) {
  std::ifstream file(path, std::ios::binary);
  const std::string plugin{std::istreambuf_iterator<char>(file), {}};
  const std::string wanted = renewed(plugin);
  if (wanted.empty()) {
    fmt::print(stderr, "{}: cannot be read, or the lines around its tables are gone\n", path);
    return 2;
  }
  if (!check) {
    fmt::print("{}", wanted);
    return 0;
  }
  if (plugin == wanted) return 0;
  fmt::print(stderr,
             "{}: its tables are not those of the field tables; renew them with\n"
             "  reckon_lua_tables {} > new.lua && mv new.lua {}\n",
             path, path, path);
  return 1;
}

}  // namespace
}  // namespace reckon::tools

int main(int argc, char** argv) {
  const bool check = argc == 3 && std::string_view(argv[1]) == "--check";
  if (argc == 2 || check) return reckon::tools::run(check, argv[argc - 1]);
  fmt::print(stderr, "usage: reckon_lua_tables [--check] FILE\n");
  return 2;
}
