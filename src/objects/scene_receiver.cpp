// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/objects/scene_receiver.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <set>
#include <system_error>
#include <utility>

namespace reckon::peer {
namespace {

namespace fs = std::filesystem;
using std::chrono::nanoseconds;

/// Files that are fetched at a time.
constexpr std::size_t kAtATime = 8;

std::uint64_t total_of(const std::vector<const PackageFile*>& files) {
  std::uint64_t total = 0;
  for (const PackageFile* file : files) total += file->size;
  return total;
}

}  // namespace

SceneReceiver::SceneReceiver(ObjectExchange& exchange, const Clock& clock, fs::path cache,
                             SceneReceiverHooks hooks)
    : exchange_(exchange), clock_(clock), cache_(std::move(cache)), hooks_(std::move(hooks)) {}

void SceneReceiver::pump() {
  if (!hooks_.pump()) throw SceneReceiptError("stopped before the scene was received");
}

std::vector<SceneOffer> SceneReceiver::find_scenes() {
  exchange_.ask(0);
  nanoseconds end = clock_.now() + kLongestAsking;
  for (bool waits = true; clock_.now() < end;) {
    pump();
    if (waits && !exchange_.offered().empty()) {
      waits = false;
      end = std::min(end, clock_.now() + nanoseconds(kFurtherOffers));
    }
  }
  exchange_.stop_asking();
  return {exchange_.offered().begin(), exchange_.offered().end()};
}

fs::path SceneReceiver::object(const ObjectHash& hash) const {
  return cache_ / "objects" / text_of(hash);
}

// What a fetch that has ended badly means to the user.
void SceneReceiver::check_state(const ObjectFetch& fetch, const ChunkStore& store,
                                std::string_view what) const {
  if (fetch.state() == FetchState::unwritable)
    throw SceneReceiptError(fmt::format("{} cannot be stored: {}", what, store.problem()));
  if (fetch.state() == FetchState::forged)
    throw SceneReceiptError(fmt::format(
        "{}: {} parts did not match their hash, so a host sends forged ones: use a key (--key)",
        what, fetch.counts().forged));
}

std::string SceneReceiver::fetch_manifest(const pdu::ObjectOffer& offer) {
  if (offer.size > kMostManifestOctets)
    throw SceneReceiptError(fmt::format("the manifest has {} octets; at most {} are accepted",
                                        offer.size, kMostManifestOctets));
  if (!exchange_.has_chunks_group(offer.pool_size))
    throw SceneReceiptError(fmt::format(
        "the offer is refused: there are no {} groups after the base group", offer.pool_size));
  MemoryStore store(offer.size);
  const FetchHandle fetch = exchange_.fetch(offer.pool_size, offer.manifest, offer.size, store);
  const nanoseconds end = clock_.now() + kPatience;
  while (fetch->state() == FetchState::running && clock_.now() < end) pump();
  check_state(*fetch, store, "the manifest");
  if (fetch->state() != FetchState::complete)
    throw SceneReceiptError(
        "the manifest did not arrive within 10 s: the peer that offered it "
        "has left, or too much is lost");
  return store.octets();
}

bool SceneReceiver::has(const PackageFile& file) const {
  const fs::path path = object(file.hash);
  std::error_code error;
  if (!fs::is_regular_file(fs::symlink_status(path, error))) return false;
  try {
    if (object_of_file(path)->hash() == file.hash) return true;
  } catch (const std::runtime_error&) {
  }
  fs::remove(path, error);
  return false;
}

bool SceneReceiver::is_done(Running& one) const {
  check_state(*one.fetch, *one.store, one.file->path);
  if (one.fetch->state() != FetchState::complete) return false;
  one.fetch.reset();
  static_cast<void>(one.store->finish());
  return true;
}

void SceneReceiver::fetch_files(const pdu::ObjectOffer& offer,
                                std::vector<const PackageFile*> missing) {
  std::vector<Running> running;
  std::uint32_t received = 0;
  nanoseconds progress = clock_.now();
  while (!missing.empty() || !running.empty()) {
    while (!missing.empty() && running.size() < kAtATime) {
      Running& one = running.emplace_back();
      one.file = missing.back();
      missing.pop_back();
      one.store = std::make_unique<FileStore>(cache_ / "objects", one.file->hash, one.file->size);
      one.fetch = exchange_.fetch(offer.pool_size, one.file->hash, one.file->size, *one.store);
      one.fetch->take_kept(one.store->kept());
    }
    pump();
    const std::size_t before = running.size();
    std::erase_if(running, [this](Running& one) { return is_done(one); });
    std::uint32_t now_received = 0;
    for (const Running& one : running) now_received += one.fetch->received().count();
    if (now_received != std::exchange(received, now_received) || running.size() != before)
      progress = clock_.now();
    if (clock_.now() - progress > kPatience)
      throw SceneReceiptError(
          fmt::format("no part of {} for 10 s: run the command again; received parts are kept",
                      running.front().file->path));
  }
}

// The scene's folder, of links to the objects. Another process may read it at the same time.
fs::path SceneReceiver::place(const pdu::ObjectOffer& offer,
                              const std::vector<PackageFile>& files) const {
  const fs::path folder = cache_ / "scenes" / text_of(offer.manifest).substr(0, 16);
  for (const PackageFile& file : files) {
    const fs::path path = folder / file.path;
    const fs::path own = path.parent_path() / fmt::format(".new.{}", ::getpid());
    std::error_code error;
    if (fs::equivalent(path, object(file.hash), error)) continue;
    fs::create_directories(path.parent_path());
    fs::remove(own, error);
    fs::create_hard_link(object(file.hash), own, error);
    if (error) fs::copy_file(object(file.hash), own);
    fs::rename(own, path);
    fs::remove(own, error);  // remains if both were links to one file
  }
  return folder / files.front().path;
}

ReceivedScene SceneReceiver::receive(const pdu::ObjectOffer& offer) {
  std::vector<PackageFile> files;
  const std::string manifest = fetch_manifest(offer);
  try {
    files = parse_manifest(manifest);
  } catch (const std::invalid_argument& error) {
    throw SceneReceiptError(fmt::format("the manifest is refused: {}", error.what()));
  }
  std::vector<const PackageFile*> missing;
  std::set<ObjectHash> named;
  ReceivedScene scene;
  for (const PackageFile& file : files) {
    scene.octets += file.size;
    if (named.insert(file.hash).second && !has(file)) missing.push_back(&file);
  }
  scene.files = files.size();
  scene.fetched = total_of(missing);
  if (!hooks_.approve(scene.fetched))
    throw SceneReceiptError(fmt::format("the download of {} octets was declined", scene.fetched));
  fetch_files(offer, std::move(missing));
  scene.file = place(offer, files);
  const std::uint64_t hash = load_received_scene(scene.file).hash;
  if (hash != offer.scene_hash)
    throw SceneReceiptError(
        fmt::format("the received scene has the hash {:016x}, but {:016x} was offered: the peer "
                    "that offered it runs another version of Reckon, or the offer is forged",
                    hash, offer.scene_hash));
  return scene;
}

}  // namespace reckon::peer
