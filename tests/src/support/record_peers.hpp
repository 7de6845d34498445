// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Peers that keep shared records equal over a network that loses, doubles and reorders.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <queue>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "reckon/peer/reliable/shared_records.hpp"

namespace reckon::test {

using namespace std::chrono_literals;
using peer::SharedRecords;
using peer::WriteResult;
using std::chrono::nanoseconds;

/// Peers on a network that loses, doubles, delays and reorders messages.
class RecordPeers {
 public:
  RecordPeers(std::size_t count, std::uint64_t seed, double loss) : random_(seed), loss_(loss) {
    for (std::size_t i = 0; i < count; ++i) add();
  }

  std::size_t add() {
    peers_.push_back(
        std::make_unique<SharedRecords>(static_cast<std::uint32_t>(10 + peers_.size()), random_()));
    for (const auto& one : peers_)
      if (one) one->meet(now_);
    cut_.push_back(std::vector<bool>(64, false));
    return peers_.size() - 1;
  }
  [[nodiscard]] SharedRecords& peer(std::size_t index) { return *peers_[index]; }
  [[nodiscard]] std::size_t size() const { return peers_.size(); }
  [[nodiscard]] bool lives(std::size_t index) const { return peers_[index] != nullptr; }
  [[nodiscard]] nanoseconds now() const { return now_; }
  [[nodiscard]] std::mt19937_64& random() { return random_; }
  void remove(std::size_t index) { peers_[index].reset(); }
  /// Nothing passes from one to the other.
  void cut(std::size_t from, std::size_t to, bool is_cut) { cut_[from][to] = is_cut; }
  void set_loss(double loss) { loss_ = loss; }

  void write(std::size_t index, const std::string& key, const std::string& value) {
    ASSERT_EQ(peer(index).write(key, std::as_bytes(std::span(value)), now_), WriteResult::written);
  }
  [[nodiscard]] std::string value(std::size_t index, const std::string& key) {
    const auto record = peer(index).find(key);
    if (!record) return "";
    const auto* letters = reinterpret_cast<const char*>(record->value.data());
    return {letters, record->value.size()};
  }

  void run(nanoseconds time) {
    const nanoseconds end = now_ + time;
    while (now_ < end) {
      nanoseconds next = end;
      if (!under_way_.empty()) next = std::min(next, under_way_.top().arrives);
      for (const auto& one : peers_)
        if (one) next = std::min(next, one->next_step());
      now_ = std::max(now_, next);
      while (!under_way_.empty() && under_way_.top().arrives <= now_) {
        const Message message = under_way_.top();
        under_way_.pop();
        if (peers_[message.to]) peers_[message.to]->take(message.kind, message.octets, now_);
      }
      for (std::size_t i = 0; i < peers_.size(); ++i) send_due(i);
    }
  }
  /// All tables have the same keys, values and versions.
  [[nodiscard]] bool are_equal(const std::vector<std::string>& keys) {
    for (const std::string& key : keys) {
      const peer::SharedRecord* first = nullptr;
      std::optional<peer::SharedRecord> kept;
      for (const auto& one : peers_) {
        if (!one) continue;
        const auto record = one->find(key);
        if (!first) {
          kept = record;
          first = kept ? &*kept : nullptr;
          is_first_empty_ = !kept;
          if (is_first_empty_) first = &none_;
          continue;
        }
        if (record.has_value() == is_first_empty_) return false;
        if (record &&
            (record->version != first->version || !std::ranges::equal(record->value, first->value)))
          return false;
      }
    }
    return true;
  }
  [[nodiscard]] std::uint64_t octets() const { return octets_; }
  [[nodiscard]] std::uint64_t sum(std::uint64_t peer::SharedRecordCounts::*count) const {
    std::uint64_t sum = 0;
    for (const auto& one : peers_) sum += one ? one->counts().*count : 0;
    return sum;
  }

 private:
  struct Message {
    nanoseconds arrives;
    std::uint64_t number;
    std::size_t to;
    pdu::AssuredKind kind;
    std::vector<std::byte> octets;
    bool operator<(const Message& other) const {
      return std::tie(other.arrives, other.number) < std::tie(arrives, number);
    }
  };

  double draw() { return std::uniform_real_distribution<double>(0, 1)(random_); }

  void send_due(std::size_t from) {
    if (!peers_[from]) return;
    std::array<std::byte, SharedRecords::kMostOctets> room;
    pdu::AssuredKind kind = pdu::AssuredKind::none;
    while (const std::size_t size = peers_[from]->take_due(now_, kind, room)) {
      octets_ += size;
      for (std::size_t to = 0; to < peers_.size(); ++to) {
        if (to == from || !peers_[to] || cut_[from][to]) continue;
        for (int copies = draw() < 0.1 ? 2 : 1; copies > 0; --copies)
          if (draw() >= loss_)
            under_way_.push({now_ + 200us + nanoseconds(static_cast<std::int64_t>(3e6 * draw())),
                             ++sent_,
                             to,
                             kind,
                             {room.begin(), room.begin() + size}});
      }
    }
  }

  std::mt19937_64 random_;
  double loss_;
  nanoseconds now_{0};
  std::vector<std::unique_ptr<SharedRecords>> peers_;
  std::vector<std::vector<bool>> cut_;
  std::priority_queue<Message> under_way_;
  std::uint64_t sent_ = 0, octets_ = 0;
  bool is_first_empty_ = false;
  peer::SharedRecord none_;
};

inline std::vector<std::string> keys_of(std::size_t count) {
  std::vector<std::string> keys;
  for (std::size_t i = 0; i < count; ++i) keys.push_back("key " + std::to_string(i));
  return keys;
}

}  // namespace reckon::test
