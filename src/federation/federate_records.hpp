// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Records that are equal at all federates, for a program: settings of the exercise, changes of the
// scene, links to objects.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "reckon/aoim/groups/peer_id.hpp"

namespace reckon::peer {

class LoopSide;
struct News;

/// A key has one value, and the version that was written last wins, also for federates that join
/// later, or were cut off. If two federates write a key at the same time, all keep the same one of
/// the two values. A record remains when its writer leaves, and cannot be removed. Not in an
/// `interop` scene.
///
///   peer::FederateRecords& records = federate.records();
///   records.on_changed([&](std::string_view key, std::span<const std::byte> value,
///                          const aoim::PeerId& writer) { apply(key, value); });
///   records.set("lights", octets);
///
/// Thread of the program, which calls the functions of Federate. set() takes effect with the next
/// step(); find() is as of the last step(). Callbacks run inside step().
class FederateRecords {
 public:
  /// Called with the key, the value, and the writer; 0:0 if it has left.
  using Changed =
      std::function<void(std::string_view, std::span<const std::byte>, const aoim::PeerId&)>;

  /// @param side outlives this
  FederateRecords(LoopSide& side, bool interop) : side_(side), interop_(interop) {}

  /// Writes a record. There are at most 1,024 records; a further one is refused. If federates write
  /// too many at the same time, all keep those with the smallest keys.
  /// @param key 1 to 63 octets, no control characters  @param value at most 1,024 octets, may be
  /// empty  @throws std::invalid_argument for another key, std::length_error for a longer value,
  /// std::logic_error in an interop scene
  void set(std::string_view key, std::span<const std::byte> value);
  /// Its value; nothing if nobody has written it. A value of set() is there once the loops have
  /// taken it: after the next step(), with threads some steps later. Valid until the next step().
  [[nodiscard]] std::optional<std::span<const std::byte>> find(std::string_view key) const;
  [[nodiscard]] std::size_t size() const noexcept { return values_.size(); }
  /// Receives the latest value of each key that another federate has written since the last step();
  /// after joining, of all keys.
  void on_changed(Changed callback) { changed_ = std::move(callback); }
  /// A record of set() was refused: there are 1,024 records, or 256 writers. A writer is one run of
  /// a federate.
  void on_refused(std::function<void(std::string_view)> callback) {
    refused_ = std::move(callback);
  }

  /// Calls back with what has changed. For Federate::step().
  void call_back(News& news);

 private:
  LoopSide& side_;
  bool interop_;
  std::map<std::string, std::vector<std::byte>, std::less<>> values_;
  Changed changed_;
  std::function<void(std::string_view)> refused_;
};

}  // namespace reckon::peer
