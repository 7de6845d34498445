// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Any octets as a mesh file whose first octet selects the format: a surface with finite triangles,
// or an error sentence. The heap stays within a multiple of the octets.
#include <array>
#include <stdexcept>
#include <string_view>

#include "reckon/haptics/geometry/surface_mesh.hpp"
#include "reckon/tests/fuzz/fuzz_target.hpp"

namespace reckon::fuzz {
namespace {

// A triangle takes 8 octets of an OBJ file, and some 600 of memory.
constexpr std::size_t kMostHeapOfOctet = 200, kMostHeap = 1 << 16;

void check_mesh(const InputOnDisk& file, std::string_view octets) {
  const std::string& name = file.write(octets);
  const HeapMeter meter;
  try {
    const auto mesh = haptics::SurfaceMesh::load({name, 0.0, false});
    require(!mesh.triangles().empty(), "a mesh without a triangle");
    require(mesh.bounds().min().allFinite() && mesh.bounds().max().allFinite(), "no finite bounds");
    require(mesh.size() > 0.0, "a mesh without size");
    haptics::ClosestPoint near;
    require(mesh.closest(mesh.bounds().center(), 2.0 * mesh.size(), near), "nothing is near");
    require(near.triangle < mesh.triangles().size(), "a triangle that is none");
  } catch (const std::runtime_error& error) {
    require(std::string_view(error.what()).starts_with("mesh "), "refused without a sentence");
  }
  require(meter.peak() <= kMostHeap + kMostHeapOfOctet * octets.size(),
          "more heap than its octets");
}

}  // namespace

void check(std::span<const std::byte> input) {
  static const std::array<InputOnDisk, 4> files{InputOnDisk(".obj"), InputOnDisk(".off"),
                                                InputOnDisk(".ply"), InputOnDisk(".stl")};
  if (input.empty()) return;
  check_mesh(files[numbers_of(input)[0] % files.size()], text_of(input.subspan(1)));
}

}  // namespace reckon::fuzz
