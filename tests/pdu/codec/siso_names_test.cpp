// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The generated tables against their source, siso_names.txt; siso_names.py compares that list with
// other sources.
#include "reckon/pdu/codec/siso_names.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/places.hpp"

namespace reckon::pdu {
namespace {

/// The lines of one section of siso_names.txt, head first.
using Section = std::vector<std::string>;

std::vector<Section> sections(bool of_bits) {
  std::ifstream file(reckon::test::source_dir() + "/pdu/codec/siso_names.txt");
  std::vector<Section> all;
  bool taken = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with('[')) {
      taken = (line.find("] ") != std::string::npos && line.find(" bits") != std::string::npos) ==
                  of_bits ||
              (!of_bits && line.ends_with(']'));
      if (taken) all.push_back({line});
    } else if (taken && !line.empty() && !line.starts_with('#')) {
      all.back().push_back(line);
    }
  }
  return all;
}

constexpr auto kTableEnd = static_cast<std::size_t>(SisoTable::end_);
constexpr auto kBitsEnd = static_cast<std::size_t>(SisoBits::end_);

TEST(SisoNames, EqualTheSourceList) {
  const auto list = sections(false);
  ASSERT_EQ(list.size() + 1, kTableEnd);
  std::size_t names = 0;
  for (std::size_t i = 1; i < kTableEnd; ++i) {
    const auto table = static_cast<SisoTable>(i);
    const Section& section = list[i - 1];
    ASSERT_EQ(siso_size(table), section.size() - 1) << section[0];
    std::map<std::uint32_t, std::string> rows;
    for (std::size_t row = 1; row < section.size(); ++row) {
      const std::size_t space = section[row].find(' ');
      const auto value = static_cast<std::uint32_t>(std::stoul(section[row]));
      rows[value] = section[row].substr(space + 1);
      EXPECT_EQ(siso_entry(table, row - 1).value, value) << section[0];
      EXPECT_EQ(siso_entry(table, row - 1).name, rows[value]) << section[0];
    }
    for (const auto& [value, name] : rows) {
      EXPECT_EQ(siso_name(table, value), name) << section[0];
      for (const std::uint32_t near : {value - 1, value + 1}) {
        EXPECT_EQ(siso_name(table, near), rows.contains(near) ? rows[near] : "") << section[0];
      }
    }
    names += rows.size();
  }
  EXPECT_GT(names, 3000U);
}

TEST(SisoNames, AreEmptyForValuesWithoutOne) {
  EXPECT_EQ(siso_name(SisoTable::none, 0), "");
  EXPECT_EQ(siso_name(SisoTable::country, 225), "United States");
  EXPECT_EQ(siso_name(SisoTable::country_code, 225), "USA");
  EXPECT_EQ(siso_name(SisoTable::country, 65535), "");
  for (std::size_t i = 0; i < kTableEnd; ++i) {
    const auto table = static_cast<SisoTable>(i);
    EXPECT_EQ(siso_name(table, 0xFFFFFFFF), "") << i;
    EXPECT_EQ(siso_name(table, 0xFFFF0000), "") << i;
  }
}

TEST(SisoNames, AllocateNothing) {
  const test::AllocationGuard guard;
  std::size_t letters = 0;
  for (std::uint32_t value = 0; value < 1000; ++value)
    letters += siso_name(SisoTable::country, value).size() +
               siso_name(SisoTable::datum_id, value * 100).size();
  const std::size_t allocations = guard.count();
  EXPECT_GT(letters, 1000U);
  EXPECT_EQ(allocations, 0U);
}

TEST(SisoBits, EqualTheSourceListAndDoNotOverlap) {
  const auto list = sections(true);
  ASSERT_EQ(list.size() + 1, kBitsEnd);
  for (std::size_t i = 1; i < kBitsEnd; ++i) {
    const auto bits = static_cast<SisoBits>(i);
    ASSERT_EQ(siso_size(bits), list[i - 1].size() - 1) << list[i - 1][0];
    EXPECT_EQ(shows_zeros(bits), list[i - 1][0].ends_with(" all"));
    std::uint64_t taken = 0;
    for (std::size_t row = 0; row < siso_size(bits); ++row) {
      const SisoBitField field = siso_bit_field(bits, row);
      std::istringstream line(list[i - 1][row + 1]);
      unsigned first = 0;
      unsigned width = 0;
      std::string name;
      line >> first >> width >> name;
      EXPECT_EQ(field.first, first);
      EXPECT_EQ(field.width, width);
      EXPECT_EQ(field.name, name);
      const std::uint64_t mask = ((std::uint64_t{1} << width) - 1) << first;
      EXPECT_EQ(taken & mask, 0U) << list[i - 1][0] << name;
      EXPECT_LE(mask, 0xFFFFFFFFU) << name;
      taken |= mask;
    }
  }
}

TEST(SisoBits, HaveFrozenAndStateForEveryEntityKind) {
  for (unsigned kind = 1; kind <= 9; ++kind) {
    for (unsigned domain = 0; domain < 7; ++domain) {
      const SisoBits bits =
          appearance_bits(EntityKind{static_cast<std::uint8_t>(kind)},
                          EntityDomain{static_cast<std::uint8_t>(domain)}, std::uint8_t{1});
      if (kind == 1 && (domain == 0 || domain == 6)) {
        EXPECT_EQ(bits, SisoBits::none);
        continue;
      }
      std::map<unsigned, std::string_view> names;
      for (std::size_t i = 0; i < siso_size(bits); ++i)
        names[siso_bit_field(bits, i).first] = siso_bit_field(bits, i).name;
      EXPECT_EQ(names[21], "frozen") << kind << domain;
      EXPECT_EQ(names[23], "state") << kind << domain;
    }
  }
}

TEST(SisoBits, ExtractAFieldFromItsWord) {
  const SisoBitField damage{"damage", 3, 2, SisoTable::damage};
  EXPECT_EQ(damage.of(0xFFFFFFFF), 3U);
  EXPECT_EQ(damage.of(0x10), 2U);
  EXPECT_EQ((SisoBitField{"all", 0, 32, SisoTable::none}.of(0x80000001)), 0x80000001U);
}

TEST(CategoryNames, DependOnKindAndDomain) {
  const auto category = [](EntityKind kind, EntityDomain domain, std::uint32_t value) {
    return siso_name(category_table(kind, domain), value);
  };
  EXPECT_EQ(category(EntityKind::platform, EntityDomain::land, 1), "Tank");
  EXPECT_EQ(category(EntityKind::platform, EntityDomain::air, 1), "Fighter/Air Defense");
  EXPECT_EQ(category(EntityKind::platform, EntityDomain::surface, 1), "Carrier");
  EXPECT_EQ(category(EntityKind::munition, EntityDomain{9}, 2), "Ballistic");
  EXPECT_EQ(category(EntityKind::environmental, EntityDomain::air, 3), "Cloud");
  EXPECT_EQ(category(EntityKind::platform, EntityDomain{6}, 1), "");
  EXPECT_EQ(category(EntityKind{10}, EntityDomain::land, 1), "");
  EXPECT_EQ(siso_name(domain_table(EntityKind::munition), 2), "Anti-Armor");
  EXPECT_EQ(siso_name(domain_table(EntityKind::platform), 2), "Air");
}

}  // namespace
}  // namespace reckon::pdu
