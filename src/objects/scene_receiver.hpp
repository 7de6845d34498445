// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Gets a scene from other peers: the manifest, then its files by their content hash, into a cache
// folder and nowhere else.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/objects/object_exchange.hpp"
#include "reckon/peer/objects/scene_package.hpp"

namespace reckon::peer {

/// A scene that is refused or cannot be fetched, with the reason and the remedy.
struct SceneReceiptError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A scene in the cache folder.
struct ReceivedScene {
  std::filesystem::path file;  ///< the scene file
  std::size_t files = 0;
  std::uint64_t octets = 0;   ///< of all files
  std::uint64_t fetched = 0;  ///< of these, octets that were not in the cache
};

/// What the receiver asks of its caller.
struct SceneReceiverHooks {
  /// Steps the exchange and waits a short time. @return false to stop
  std::function<bool()> pump;
  /// Whether so many octets may be fetched.
  std::function<bool(std::uint64_t octets)> approve;
};

/// One thread. Waits until it is done, and calls the hooks meanwhile.
class SceneReceiver {
 public:
  /// Time without progress after which a fetch fails.
  static constexpr std::chrono::seconds kPatience{10};
  /// Time to wait for offers, and for further ones after the first.
  static constexpr std::chrono::milliseconds kLongestAsking{3000}, kFurtherOffers{150};

  /// @param exchange, clock outlive this  @param cache created if missing
  SceneReceiver(ObjectExchange& exchange, const Clock& clock, std::filesystem::path cache,
                SceneReceiverHooks hooks);

  /// The scenes that are offered now; empty if there are none within kLongestAsking.
  [[nodiscard]] std::vector<SceneOffer> find_scenes();
  /// Gets the files of an offered scene and checks it. A file that is in the cache is not fetched.
  /// What an earlier run has fetched in part is completed. @throws SceneReceiptError,
  /// SceneFileError if the scene itself is refused, std::filesystem::filesystem_error
  [[nodiscard]] ReceivedScene receive(const pdu::ObjectOffer& offer);

 private:
  struct Running {
    const PackageFile* file = nullptr;
    std::unique_ptr<FileStore> store;
    FetchHandle fetch;
  };

  void pump();
  [[nodiscard]] std::string fetch_manifest(const pdu::ObjectOffer& offer);
  [[nodiscard]] bool has(const PackageFile& file) const;
  void fetch_files(const pdu::ObjectOffer& offer, std::vector<const PackageFile*> missing);
  [[nodiscard]] bool is_done(Running& one) const;
  [[nodiscard]] std::filesystem::path place(const pdu::ObjectOffer& offer,
                                            const std::vector<PackageFile>& files) const;
  [[nodiscard]] std::filesystem::path object(const ObjectHash& hash) const;
  void check_state(const ObjectFetch& fetch, const ChunkStore& store, std::string_view what) const;

  ObjectExchange& exchange_;
  const Clock& clock_;
  std::filesystem::path cache_;
  SceneReceiverHooks hooks_;
};

}  // namespace reckon::peer
