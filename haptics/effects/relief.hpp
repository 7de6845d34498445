// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A texture from a picture: bark, cloth, an engraving.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>
#include <utility>

#include "reckon/haptics/effects/effect_hooks.hpp"
#include "reckon/haptics/effects/effect_parameter.hpp"
#include "reckon/haptics/effects/effect_slope.hpp"
#include "reckon/haptics/geometry/height_map.hpp"
#include "reckon/haptics/image_files/image_file.hpp"

namespace reckon::haptics {

/// A picture laid over the object's x-y plane, seen from +z, and repeated without end.
struct ReliefPicture {
  std::filesystem::path file;  ///< PNG or PGM; empty: random ground by `seed`
  double width = 0.02;         ///< [m], width of the picture along the object's x axis
  double height = 1e-4;        ///< [m], height difference from black to white
  double seed = 1.0;           ///< seed of the random ground
};

/// F = -N grad h along the surface, as for Texture, with h from a picture. Slopes are limited to 1.
/// Copies share the picture.
class Relief : public CountedEffect<Relief> {
 public:
  using Parameters = ReliefPicture;
  static constexpr bool kInContactOnly = true;
  static constexpr bool kSharesMemory = true;
  static constexpr std::string_view kName = "relief";
  static constexpr std::string_view kKey = "relief";
  static constexpr std::string_view kCost = "sixteen heights of the picture";
  static constexpr EffectFile kFile{
      "file", "PNG or PGM beside the scene file, white is high; when absent, random ground."};
  static constexpr std::array<EffectParameter<ReliefPicture>, 3> kParameters{{
      {"width", "m", &ReliefPicture::width, 1e-4, 10.0, 0.02,
       "Of the picture along the object's x axis; it repeats after this width; lower feels finer."},
      {"height", "m", &ReliefPicture::height, 0.0, 1e-2, 1e-4,
       "From black to white; higher feels rougher."},
      {"seed", "", &ReliefPicture::seed, 0.0, 1e9, 1.0,
       "Of the random ground without a picture; equal on all peers."},
  }};

  /// @throws std::invalid_argument when a value is out of the table's range, or the picture cannot
  /// be read.
  explicit Relief(const ReliefPicture& picture) {
    check_parameters(kParameters, picture);
    ground_ = std::make_shared<const Ground>(picture, map_of(picture));
  }

  /// Hook: the force along the surface [N].
  [[nodiscard]] Eigen::Vector3d force(const EffectContact& contact) const noexcept {
    if (!contact.in_contact) return Eigen::Vector3d::Zero();
    const Ground& ground = *ground_;
    const double shown = shown_of_waves(ground.wavelength, contact.slip().norm() * contact.dt);
    if (!(shown > 0.0)) return Eigen::Vector3d::Zero();
    const Eigen::Vector2d place = contact.object->place.head<2>().cwiseQuotient(ground.size);
    Eigen::Vector3d slope = Eigen::Vector3d::Zero();
    slope.head<2>() = ground.picture.height * ground.map.gradient(place).cwiseQuotient(ground.size);
    const double steep = slope.norm();
    if (steep > 1.0) slope /= steep;
    return shown * slope_force(contact, slope);
  }

  /// Hook: it reserves no damping.
  [[nodiscard]] double damping() const noexcept { return 0.0; }

  [[nodiscard]] const ReliefPicture& parameters() const noexcept { return ground_->picture; }
  [[nodiscard]] const HeightMap& map() const noexcept { return ground_->map; }
  /// Wavelength of a sine wave with the same spread of heights and slopes [m].
  [[nodiscard]] double wavelength() const noexcept { return ground_->wavelength; }

 private:
  struct Ground {
    ReliefPicture picture;
    HeightMap map;
    Eigen::Vector2d size;  // [m], of a period
    double wavelength;     // [m]

    Ground(const ReliefPicture& from, HeightMap heights)
        : picture(from),
          map(std::move(heights)),
          size(from.width,
               from.width * static_cast<double>(map.rows()) / static_cast<double>(map.columns())),
          wavelength(map.wavelength(size)) {}
  };

  // The first row of a picture is its top.
  static HeightMap map_of(const ReliefPicture& picture) {
    if (picture.file.empty()) return HeightMap::random(static_cast<std::uint64_t>(picture.seed));
    GreyImage image = read_image(picture.file);
    const auto width = static_cast<std::ptrdiff_t>(image.width);
    for (std::size_t row = 0; row < image.height / 2; ++row) {
      const auto top = image.pixels.begin() + static_cast<std::ptrdiff_t>(row) * width;
      const auto bottom =
          image.pixels.begin() + static_cast<std::ptrdiff_t>(image.height - 1 - row) * width;
      std::swap_ranges(top, top + width, bottom);
    }
    return {image.width, image.height, std::move(image.pixels)};
  }

  std::shared_ptr<const Ground> ground_;
};

}  // namespace reckon::haptics
