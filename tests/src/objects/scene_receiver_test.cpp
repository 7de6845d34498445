// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A host without a scene gets it from another one, into its cache folder.
#include "reckon/peer/objects/scene_receiver.hpp"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

#include "reckon/tests/src/support/object_hosts.hpp"
#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using peer::SceneReceiptError;

constexpr const char* kMesh =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

std::string content(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Host 0 plays a scene with a mesh of this size, and host 1 has an empty cache.
class SceneReceiver : public testing::Test {
 protected:
  void play(std::size_t mesh_octets = 1000, const std::string& more = "") {
    fs::create_directories(played_.file("meshes"));
    std::string mesh = kMesh;
    for (const std::string& text = random_text(mesh_octets); mesh.size() < mesh_octets;)
      mesh += "# " + text.substr(mesh.size(), 62) + "\n";
    std::ofstream(played_.file("meshes/one.obj")) << mesh;
    std::ofstream(played_.file("scene.toml"))
        << "[[object]]\nname = 'one'\nmesh = 'meshes/one.obj'\n"
        << more;
    offer(peer::load_scene_file(played_.file("scene.toml")));
  }

  void offer(const peer::SceneFile& scene) {
    const auto objects = peer::package_of(scene);
    for (const auto& object : objects) hosts_->host(0).serve(object);
    pdu::ObjectOffer offer;
    offer.scene_hash = scene.hash;
    offer.manifest = objects.front()->hash();
    offer.size = objects.front()->layout().size();
    offer.pool_size = kObjectPool;
    hosts_->host(0).offer(offer);
  }
  /// New hosts, which serve nothing.
  void renew() { hosts_ = std::make_unique<ObjectHosts>(2); }
  /// Offers a manifest of any text.
  void offer_manifest(const std::string& text) {
    const auto object = peer::object_of(text);
    hosts_->serve(0, object);
  }

  peer::ReceivedScene receive() {
    peer::SceneReceiver receiver(hosts_->host(1), hosts_->clock(), cache_.file("reckon"),
                                 {[this] {
                                    hosts_->step();
                                    return ++steps_ < stops_;
                                  },
                                  [this](std::uint64_t octets) {
                                    asked_ = octets;
                                    return octets <= approved_;
                                  }});
    const auto offers = receiver.find_scenes();
    if (offers.empty()) throw SceneReceiptError("no offer");
    return receiver.receive(offers.front().offer);
  }

  static std::string random_text(std::size_t size) {
    std::string text = random_octets(size);
    for (char& letter : text) letter = static_cast<char>('a' + (letter & 15));
    return text;
  }

  static peer::ImpairmentLaw law() {
    peer::ImpairmentLaw law;
    law.loss = 0.1;
    law.delay = 200us;
    return law;
  }

  std::unique_ptr<ObjectHosts> hosts_ = std::make_unique<ObjectHosts>(2, law());
  ScratchFolder played_, cache_;
  std::uint64_t approved_ = 64'000'000, asked_ = 0;
  std::uint64_t steps_ = 0, stops_ = 1'000'000;
};

TEST_F(SceneReceiver, HasEqualFilesInItsCache) {
  play(300'000);
  const peer::ReceivedScene scene = receive();
  EXPECT_EQ(scene.files, 2u);
  EXPECT_EQ(scene.fetched, scene.octets);
  EXPECT_EQ(asked_, scene.octets);
  EXPECT_EQ(content(scene.file), content(played_.file("scene.toml")));
  EXPECT_EQ(content(scene.file.parent_path() / "meshes/one.obj"),
            content(played_.file("meshes/one.obj")));
  EXPECT_EQ(scene.file.string().find(cache_.file("reckon")), 0u);
  EXPECT_EQ(receive().fetched, 0u) << "everything is in the cache";
}

TEST_F(SceneReceiver, FetchesAgainWhatChangedInItsCache) {
  play(5'000);
  const fs::path file = receive().file;
  std::ofstream(file, std::ios::app) << "# edited by hand\n";
  EXPECT_EQ(receive().fetched, fs::file_size(played_.file("scene.toml")));
  EXPECT_EQ(content(file), content(played_.file("scene.toml")));
}

TEST_F(SceneReceiver, AsksBeforeItFetches) {
  play(5'000);
  approved_ = 100;
  EXPECT_THROW(static_cast<void>(receive()), SceneReceiptError);
  EXPECT_FALSE(fs::exists(cache_.file("reckon/scenes")));
}

TEST_F(SceneReceiver, CompletesWhatAnEarlierRunBegan) {
  play(16'000'000);
  stops_ = 2400;
  EXPECT_THROW(static_cast<void>(receive()), SceneReceiptError);
  stops_ = 1'000'000;
  hosts_->run(2s, [] { return false; });
  const std::uint64_t before = hosts_->host(0).counts().chunks_sent;
  const peer::ReceivedScene scene = receive();
  EXPECT_EQ(content(scene.file.parent_path() / "meshes/one.obj"),
            content(played_.file("meshes/one.obj")));
  const std::uint64_t needed = hosts_->host(0).counts().chunks_sent - before;
  EXPECT_LT(needed, 12'000u) << "of more than 12,500";
  EXPECT_GT(before, 500u);
}

// After a power failure the list of chunks may be there without their octets.
TEST_F(SceneReceiver, DoesNotCallOldOctetsForged) {
  play(8'000'000);
  const auto mesh = peer::object_of_file(played_.file("meshes/one.obj"));
  {
    peer::FileStore store(cache_.file("reckon/objects"), mesh->hash(), mesh->layout().size());
    peer::ChunkMap all(mesh->layout().chunks());
    for (std::uint32_t i = 0; i < all.chunks(); ++i) all.add(i);
    store.keep(all);
  }
  const peer::ReceivedScene scene = receive();
  EXPECT_EQ(content(scene.file.parent_path() / "meshes/one.obj"),
            content(played_.file("meshes/one.obj")));
}

// Two peers of one host join at the same time.
TEST(FileStore, GivesASecondProcessFilesOfItsOwn) {
  const ScratchFolder folder;
  const auto object = peer::object_of(random_octets(5000));
  const std::string octets(5000, 'a');
  peer::FileStore first(folder.file("cache"), object->hash(), 5000);
  {
    peer::FileStore second(folder.file("cache"), object->hash(), 5000);
    ASSERT_TRUE(first.write(0, std::as_bytes(std::span(octets))));
    ASSERT_TRUE(second.write(0, std::as_bytes(std::span(octets)).first(10)));
    std::array<std::byte, 20> read{};
    ASSERT_TRUE(second.read(0, read));
    EXPECT_EQ(read[10], std::byte{0}) << "nothing of the first";
  }
  const auto files = [&] {
    return std::distance(fs::directory_iterator(folder.file("cache")), fs::directory_iterator());
  };
  EXPECT_EQ(files(), 2);
  EXPECT_EQ(content(first.finish()), octets);
  EXPECT_EQ(files(), 1);
}

TEST_F(SceneReceiver, RefusesOtherHashThanOffered) {
  play();
  peer::SceneFile scene = peer::load_scene_file(played_.file("scene.toml"));
  scene.hash += 1;
  scene.hash_in_file += 1;
  renew();
  offer(scene);
  EXPECT_THROW(static_cast<void>(receive()), SceneReceiptError);
}

TEST_F(SceneReceiver, RefusesHostileManifests) {
  const std::string hash(64, 'a');
  for (const std::string path : {"../evil", "/tmp/evil", "a/../../evil"}) {
    renew();
    offer_manifest("reckon scene 1\n" + hash + " 4 " + path + "\n");
    EXPECT_THROW(static_cast<void>(receive()), SceneReceiptError) << path;
  }
  EXPECT_FALSE(fs::exists(cache_.file("reckon/scenes")));
}

TEST_F(SceneReceiver, RefusesScenesThatReadOtherFiles) {
  std::ofstream(played_.file("secret")) << kMesh;
  for (const std::string& name : {played_.file("secret"), std::string("../../../../secret")}) {
    renew();
    const auto scene = peer::object_of("[[object]]\nname = 'one'\nmesh = '" + name + "'\n");
    hosts_->host(0).serve(scene);
    offer_manifest(peer::manifest_text({{scene->hash(), scene->layout().size(), "scene.toml"}}));
    EXPECT_THROW(static_cast<void>(receive()), peer::SceneFileError) << name;
  }
}

TEST_F(SceneReceiver, FailsIfTheFilesNeverCome) {
  const auto missing = peer::object_of("nobody serves this");
  offer_manifest(peer::manifest_text({{missing->hash(), missing->layout().size(), "scene.toml"}}));
  EXPECT_THROW(static_cast<void>(receive()), SceneReceiptError);
}

TEST_F(SceneReceiver, FailsIfItsCacheIsAFile) {
  play();
  std::ofstream(cache_.file("reckon")) << "a file";
  EXPECT_THROW(static_cast<void>(receive()), std::runtime_error);
}

TEST_F(SceneReceiver, FindsEachSceneOnce) {
  play();
  offer_manifest("reckon scene 1\n");
  peer::SceneReceiver receiver(hosts_->host(1), hosts_->clock(), cache_.file("reckon"),
                               {[this] {
                                  hosts_->step();
                                  return true;
                                },
                                [](std::uint64_t) { return true; }});
  EXPECT_EQ(receiver.find_scenes().size(), 2u);
}

}  // namespace
}  // namespace reckon::test
