// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The size of a datagram bounds the work and memory for it, whatever its octets claim. The fuzz
// targets search for exceptions; docs/robustness.md states the bounds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "reckon/pdu/pdu_types.hpp"
#include "reckon/pdu/type_names.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/wire_samples.hpp"
#include "reckon/tools/datagrams/pdu_row.hpp"
#include "reckon/tools/datagrams/restored_states.hpp"
#include "reckon/tools/inspect/output/json_lines.hpp"
#include "reckon/tools/inspect/output/text_lines.hpp"

namespace reckon::tools {
namespace {

using Octets = std::vector<std::byte>;
using ::testing::HasSubstr;

constexpr std::size_t kLargest = 65507;  // UDP payload over IPv4 [octets]

struct Named {
  std::string name;
  Octets octets;
};

/// A PDU of `size` octets: header and fixed part as constructed, then zeros.
template <typename Pdu>
Octets pdu_of(std::size_t size) {
  const Pdu pdu;
  Octets octets(size);
  EXPECT_EQ(encode(pdu, octets), pdu::kFixedSize<Pdu>);
  pdu::store_big_endian(octets.data() + 8, static_cast<std::uint16_t>(size));
  return octets;
}

/// A Data PDU with `count` empty datums; datum number `broken` (from 1) claims 2^32 - 1 bits.
Octets datums(std::size_t count, std::size_t broken) {
  Octets octets = pdu_of<pdu::Data>(40 + 8 * count);
  pdu::store_big_endian(octets.data() + 36, static_cast<std::uint32_t>(count));
  pdu::store_big_endian(octets.data() + 40 + 8 * (broken - 1) + 4, std::uint32_t{0xFFFFFFFF});
  return octets;
}

/// The largest datagram, full of copies of `pdu`.
Octets full_of(const Octets& pdu) {
  Octets datagram;
  while (datagram.size() + pdu.size() <= kLargest)
    datagram.insert(datagram.end(), pdu.begin(), pdu.end());
  return datagram;
}

/// An Attribute PDU of empty record sets whose count is one too many.
Octets too_many_sets() {
  constexpr std::size_t kSets = 8000;
  Octets octets = pdu_of<pdu::Attribute>(32 + 8 * kSets);
  pdu::store_big_endian(octets.data() + 30, static_cast<std::uint16_t>(kSets + 1));
  return octets;
}

Octets unknown_type() {
  Octets octets = pdu_of<pdu::Acknowledge>(pdu::kFixedSize<pdu::Acknowledge>);
  octets.resize(pdu::kHeaderSize);
  octets[2] = std::byte{200};
  octets[9] = std::byte{12};
  return octets;
}

template <typename... T>
void add_samples(std::vector<Named>& all, pdu::TypeList<T...>) {
  (all.push_back({std::string(pdu::snake_name(T::kPduType)),
                  test::sample_octets(pdu::snake_name(T::kPduType))}),
   ...);
}

/// Compressed States with as many states as fit, without octets.
Octets empty_states() {
  Octets octets = pdu_of<pdu::CompressedStates>(kLargest);
  pdu::store_big_endian(octets.data() + 18, std::uint16_t{0xFFFF});
  return octets;
}

/// Expensive datagrams, and every golden sample: whole, cut, and damaged.
std::vector<Named> datagrams() {
  std::vector<Named> all;
  add_samples(all, pdu::PduTypes{});
  std::mt19937_64 random(3);
  for (std::size_t i = 0, samples = all.size(); i < samples; ++i) {
    Octets cut = all[i].octets;
    cut.resize(1 + random() % cut.size());
    Octets damaged = all[i].octets;
    for (std::size_t n = 0; n < 4; ++n)
      damaged[12 + random() % (damaged.size() - 12)] = std::byte{255};
    all.push_back({all[i].name + " cut", cut});
    all.push_back({all[i].name + " damaged", damaged});
    all.push_back({"full of " + all[i].name, full_of(damaged)});
  }
  all.push_back({"nothing", {}});
  all.push_back({"zeros", Octets(kLargest)});
  all.push_back({"sevens", Octets(kLargest, std::byte{7})});
  all.push_back({"full of an unknown type", full_of(unknown_type())});
  all.push_back({"datum bomb", datums(2, 1)});
  all.push_back({"thousands of datums", datums(8000, 8000)});
  all.push_back({"thousands of record sets", too_many_sets()});
  all.push_back({"thousands of compressed states", empty_states()});
  return all;
}

peer::SourceDatagram datagram_of(const Octets& octets) {
  peer::SourceDatagram datagram;
  datagram.frame = 1;
  datagram.bytes = octets;
  return datagram;
}

/// Number of compressed states that are restored from a datagram.
std::size_t compressed_states(const Octets& datagram) {
  std::size_t count = 0;
  for (const pdu::BundledPdu& bundled : pdu::BundleReader(datagram)) {
    pdu::CompressedStates states;
    if (decode(bundled.bytes, states) != pdu::DecodeError::none) continue;
    pdu::CompressedStateReader reader(states);
    for (pdu::CompressedState one; reader.next(one);) ++count;
  }
  return count;
}

/// 4 times the datagram; for a small one, the size of an error sentence. 2 KiB for each restored
/// state.
std::size_t heap_bound(const Octets& octets) {
  return std::max<std::size_t>(4 * octets.size(), 1024) + 2048 * compressed_states(octets);
}

/// 64 times the datagram with plain states, plus 1 KiB.
std::size_t text_bound(const Octets& octets) {
  return 64 * (octets.size() + pdu::kFixedSize<pdu::EntityState> * compressed_states(octets)) +
         1024;
}

TEST(DatagramBounds, InspectorHoldsAtMostFourTimesItsSize) {
  for (const auto& [name, octets] : datagrams()) {
    const peer::SourceDatagram datagram = datagram_of(octets);
    std::size_t peak = 0;
    {
      const test::AllocationGuard guard;
      DatagramInspector inspector;
      inspector.inspect(datagram, [](const PduRow&) { return true; });
      peak = guard.peak_octets();
    }
    EXPECT_LE(peak, heap_bound(octets)) << name << " of " << octets.size() << " octets";
  }
}

TEST(DatagramBounds, ThousandsOfCompressedStatesAreLeftOut) {
  const Octets octets = empty_states();
  std::size_t restored = 0;
  DatagramInspector inspector;
  inspector.inspect(datagram_of(octets), [&](const PduRow& row) {
    restored += row.restored->size();
    return true;
  });
  EXPECT_EQ(restored, RestoredStates::kMost);
}

TEST(DatagramBounds, CodecAllocatesNoHeapForAnyOctets) {
  for (const auto& [name, octets] : datagrams()) {
    const test::AllocationGuard guard;
    std::size_t decoded = 0;
    for (const pdu::BundledPdu& bundled : pdu::BundleReader(octets)) {
      (void)pdu::visit(bundled.bytes, bundled.header, [&](const auto&) { ++decoded; });
    }
    const std::size_t allocations = guard.count();
    EXPECT_EQ(allocations, 0U) << name << ", " << decoded << " PDUs";
  }
}

TEST(DatagramBounds, RowsAreBoundedByTheHeadersThatFit) {
  for (const auto& [name, octets] : datagrams()) {
    const peer::SourceDatagram datagram = datagram_of(octets);
    std::size_t rows = 0;
    DatagramInspector inspector;
    inspector.inspect(datagram, [&](const PduRow&) { return ++rows != 0; });
    EXPECT_LE(rows, octets.size() / pdu::kHeaderSize + 1) << name;
  }
}

TEST(DatagramBounds, TextIsAtMost64TimesTheDatagram) {
  for (const auto& [name, octets] : datagrams()) {
    const peer::SourceDatagram datagram = datagram_of(octets);
    std::string line;
    std::string tree;
    DatagramInspector inspector;
    inspector.inspect(datagram, [&](const PduRow& row) {
      append_json_line(line, row, true);
      append_tree(tree, row, false);
      return true;
    });
    EXPECT_LE(line.size(), text_bound(octets)) << name;
    EXPECT_LE(tree.size(), text_bound(octets)) << name;
  }
}

/// The record at fault is found by bisection, not by walking from each record.
TEST(DatagramBounds, NamesABrokenDatumAmongThousands) {
  for (const std::size_t broken : {1, 2, 3, 4000, 7999, 8000}) {
    const Octets octets = datums(8000, broken);
    std::string reason;
    std::size_t offset = 0;
    DatagramInspector inspector;
    inspector.inspect(datagram_of(octets), [&](const PduRow& row) {
      EXPECT_EQ(row.rule, "E-RECORD");
      reason = row.reason;
      offset = row.fault_offset;
      return true;
    });
    EXPECT_THAT(reason, HasSubstr("number " + std::to_string(broken) + " of 8000 "));
    EXPECT_EQ(offset, 40 + 8 * (broken - 1));
  }
}

}  // namespace
}  // namespace reckon::tools
