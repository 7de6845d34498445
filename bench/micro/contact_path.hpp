// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A fixed stroke over a generated torus, to compare contact renderers. contact_path_bench measures
// ours. A program with another library includes this header, or reads the two files of write().
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <vector>

#include "reckon/bench/statistics/quantile.hpp"
#include "reckon/tests/support/touch_meshes.hpp"

namespace reckon::bench {

/// A hand at `speed` [m/s] and 1 kHz, 2 mm below the surface of a torus of 69,696 triangles and a
/// diagonal of 0.2 m; forwards and back, so that rounds follow each other without a jump.
struct ContactPath {
  static constexpr double kSize = 0.2;
  static constexpr double kDepth = 2e-3;
  static constexpr int kTicks = 4000;

  haptics::SurfaceMesh mesh = test::make_mesh(test::torus(264, 132), kSize);
  Eigen::Vector3d start = Eigen::Vector3d::Zero();  ///< outside
  std::vector<Eigen::Vector3d> devices;             ///< one for each tick

  explicit ContactPath(double speed) {
    test::Stroke stroke(mesh, speed * 1e-3, kDepth, 7);
    start = stroke.start();
    for (int i = 0; i < kTicks / 2; ++i) devices.push_back(stroke.next());
    for (std::size_t i = devices.size(); i > 0; --i) devices.push_back(devices[i - 1]);
  }

  /// Writes torus.obj and path.txt: the start, then a line x y z [m] for each tick.
  /// @throws std::runtime_error if the folder cannot be written.
  void write(const std::filesystem::path& folder) const {
    test::MeshData data;
    for (const haptics::Triangle& t : mesh.triangles()) {
      const auto first = static_cast<std::uint32_t>(data.vertices.size());
      data.vertices.insert(data.vertices.end(), {t.a, t.b, t.c});
      data.triangles.push_back({first, first + 1, first + 2});
    }
    test::write_obj(data, folder / "torus.obj");
    std::ofstream out(folder / "path.txt");
    out.precision(17);
    out << start.transpose() << '\n';
    for (const Eigen::Vector3d& p : devices) out << p.transpose() << '\n';
    if (!out) throw std::runtime_error("cannot write " + folder.string());
  }
};

/// Nanoseconds of each tick of a path: the minimum over all rounds, because delays by other
/// programs are not part of the tick, minus the cost of the clock itself.
class TickTimes {
 public:
  /// One more round: calls tick(device) for each point of the path.
  template <class Tick>
  void round(const ContactPath& path, Tick&& tick) {
    least_.resize(path.devices.size(), std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < path.devices.size(); ++i) {
      const auto before = Clock::now();
      tick(path.devices[i]);
      const auto after = Clock::now();
      clock_ns_ = std::min(clock_ns_, nanoseconds(after, Clock::now()));
      least_[i] = std::min(least_[i], nanoseconds(before, after));
    }
  }

  /// Quantile over all ticks: 0.5 is the median.
  [[nodiscard]] double share_below(double share) const {
    std::vector<double> ticks = least_;
    return bench::quantile(ticks, share) - clock_ns_;
  }
  [[nodiscard]] double mean() const {
    double sum = 0.0;
    for (const double ns : least_) sum += ns;
    return sum / static_cast<double>(least_.size()) - clock_ns_;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static double nanoseconds(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double, std::nano>(to - from).count();
  }

  std::vector<double> least_;
  double clock_ns_ = std::numeric_limits<double>::infinity();
};

}  // namespace reckon::bench
