// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Manifests of scenes: what is offered, and which ones a receiver refuses.
#include "reckon/peer/objects/scene_package.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "reckon/peer/objects/missing_chunks.hpp"
#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::test {
namespace {

using peer::parse_manifest;

const std::string kHash(64, 'a');

std::string manifest(const std::string& lines) { return "reckon scene 1\n" + lines; }
std::string line(const std::string& path, const std::string& size = "10") {
  return kHash + " " + size + " " + path + "\n";
}

struct Hostile {
  std::string text, reason;
};

std::vector<Hostile> hostile_manifests() {
  std::string many;
  for (int i = 0; i < 1001; ++i) many += line("f" + std::to_string(i));
  return {
      {"", "names no file"},
      {"reckon scene 1\n", "names no file"},
      {"reckon scene 2\n" + line("a"), "line 1 is not"},
      {line("a"), "line 1 is not"},
      {"reckon scene 1", "line 1 has no end"},
      {manifest(kHash + " 10 a"), "line 2 has no end"},
      {manifest("\n"), "line 2 is not 'HASH"},
      {manifest("x\n"), "line 2 is not 'HASH"},
      {manifest(kHash + " 10\n"), "line 2 is not 'HASH"},
      {manifest(kHash.substr(1) + " 10 a\n"), "does not begin with a hash"},
      {manifest("A" + kHash.substr(1) + " 10 a\n"), "does not begin with a hash"},
      {manifest("../../../../etc/passwd 10 a\n"), "does not begin with a hash"},
      {manifest(line("a", "-1")), "has no size"},
      {manifest(line("a", "")), "has no size"},
      {manifest(line("a", "0x10")), "has no size"},
      {manifest(line("a", "268435457")), "has no size"},
      {manifest(line("a", "99999999999999999999999")), "has no size"},
      {manifest(line("")), "the path is empty"},
      {manifest(line("/etc/passwd")), "is absolute"},
      {manifest(line("..")), "leads out"},
      {manifest(line("../a")), "leads out"},
      {manifest(line("a/../../b")), "leads out"},
      {manifest(line("a/..")), "leads out"},
      {manifest(line("./a")), "has an empty part"},
      {manifest(line("a//b")), "has an empty part"},
      {manifest(line("a/")), "has an empty part"},
      {manifest(line("..\\a")), "a backslash"},
      {manifest(line(std::string("a\0b", 3))), "a control character"},
      {manifest(line("a\x1b[2J")), "a control character"},
      {manifest(line(std::string(256, 'a'))), "longer than 255"},
      {manifest(line("a") + line("b") + line("a")), "a is named twice"},
      {manifest(line("a") + line("a/b")), "a is named as a file and as a folder"},
      {manifest(many), "exceeds 1000 files"},
      {manifest(std::string(600'000, 'a')), "has more than 524288 octets"},
  };
}

TEST(SceneManifest, IsRefusedIfHostile) {
  const auto all = hostile_manifests();
  ASSERT_GE(all.size(), 30u);
  for (const Hostile& one : all) {
    try {
      static_cast<void>(parse_manifest(one.text));
      ADD_FAILURE() << "accepted: " << one.text.substr(0, 200);
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(one.reason), std::string::npos) << error.what();
    }
  }
}

TEST(SceneManifest, IsReadAsWritten) {
  const std::string text = manifest(line("a b.toml", "0") + line("meshes/ä.obj", "268435456"));
  const auto files = parse_manifest(text);
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[1].path, "meshes/ä.obj");
  EXPECT_EQ(files[1].size, peer::kMostObjectOctets);
  EXPECT_EQ(peer::manifest_text(files), text);
}

TEST(ScenePackage, HasTheFilesThatTheSceneNames) {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder.file("meshes"));
  std::ofstream(folder.file("meshes/one.obj"))
      << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  std::ofstream(folder.file("other.txt")) << "not named";
  const std::string text =
      "[[object]]\nname = 'one'\nmesh = 'meshes/one.obj'\n[[object]]\nname = 'two'\nmesh = "
      "'meshes/one.obj'\nposition = '1 0 0 m'\n";
  std::ofstream(folder.file("scene.toml")) << text;
  peer::SceneFile scene = peer::load_scene_file(folder.file("scene.toml"));
  const auto objects = peer::package_of(scene);
  ASSERT_EQ(objects.size(), 3u);
  std::string octets(objects[0]->layout().size(), '\0');
  ASSERT_TRUE(objects[0]->read_chunk(1, std::as_writable_bytes(std::span(octets))));
  const auto files = parse_manifest(octets);
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[0].path, "scene.toml");
  EXPECT_EQ(files[0].size, text.size());
  EXPECT_EQ(files[1].path, "meshes/one.obj");
  EXPECT_EQ(files[1].hash, objects[2]->hash());
  scene.hash += 1;
  EXPECT_THROW(static_cast<void>(peer::package_of(scene)), std::runtime_error);
}

TEST(ScenePackage, RefusesFilesOutsideItsFolder) {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder.file("scenes"));
  std::ofstream(folder.file("one.obj"))
      << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  for (const std::string& name : {std::string("../one.obj"), folder.file("one.obj")}) {
    std::ofstream(folder.file("scenes/scene.toml"))
        << "[[object]]\nname = 'one'\nmesh = '" << name << "'\n";
    const auto scene = peer::load_scene_file(folder.file("scenes/scene.toml"));
    EXPECT_THROW(static_cast<void>(peer::package_of(scene)), std::runtime_error);
    try {
      static_cast<void>(peer::load_received_scene(folder.file("scenes/scene.toml")));
      ADD_FAILURE() << name;
    } catch (const peer::SceneFileError& error) {
      EXPECT_EQ(error.problems().at(0).line, 3u);
      EXPECT_NE(std::string(error.what()).find("outside the folder of the scene"),
                std::string::npos);
    }
  }
}

TEST(MissingChunks, AreNamedCompletelyByRequests) {
  std::uint64_t random = 1;
  for (const std::uint32_t chunks : {1u, 7u, 64u, 1000u, 30000u}) {
    for (const unsigned share : {1u, 10u, 128u, 250u, 255u}) {
      peer::ChunkMap received(chunks), named(chunks);
      for (std::uint32_t i = 0; i < chunks; ++i) {
        random = random * 6364136223846793005u + 1442695040888963407u;
        if ((random >> 56) < share) received.add(i);
      }
      std::array<std::byte, 1200> room;
      for (std::uint32_t next = 0; next < chunks;) {
        pdu::ObjectRequest request;
        const std::uint32_t from = next;
        const std::size_t octets = peer::store_missing(received, from, request, room, next);
        ASSERT_GT(next, from);
        peer::for_each_missing(request, std::span(room).first(octets), chunks,
                               [&](std::uint32_t first, std::uint32_t count) {
                                 for (std::uint32_t i = 0; i < count; ++i) named.add(first + i);
                               });
      }
      for (std::uint32_t i = 0; i < chunks; ++i)
        ASSERT_NE(named.has(i), received.has(i)) << chunks << " " << share << " " << i;
    }
  }
}

TEST(MissingChunks, OfHostileRequestsStayWithinTheObject) {
  const std::vector<std::byte> octets(1200, std::byte{0xFF});
  for (const unsigned form : {0u, 1u, 2u, 255u}) {
    for (const std::uint32_t first : {0u, 99u, 100u, 0xFFFFFFFFu}) {
      pdu::ObjectRequest request;
      request.form = static_cast<std::uint8_t>(form);
      request.first = first;
      for (std::size_t size = 0; size < octets.size(); size += 7)
        peer::for_each_missing(request, std::span(octets).first(size), 100,
                               [](std::uint32_t from, std::uint32_t count) {
                                 ASSERT_LE(std::uint64_t{from} + count, 100u);
                               });
    }
  }
}

}  // namespace
}  // namespace reckon::test
