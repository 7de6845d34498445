// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/tracks/motions.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "reckon/deadreckon/motion/rotation.hpp"
#include "reckon/pdu/random/split_mix.hpp"

namespace reckon::bench {
namespace {

using deadreckon::MotionSample;
using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;
constexpr double kGravity = 9.81;  // [m/s^2]

/// The same numbers on every machine, unlike the distributions of the standard library.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : engine_(seed) {}
  double between(double low, double high) { return low + (high - low) * share(); }
  /// Normally distributed (Box-Muller).
  double normal(double deviation) {
    const double radius = std::sqrt(-2 * std::log(1 - share()));
    return deviation * radius * std::cos(2 * kPi * share());
  }
  Vector3d normal3(double deviation) {
    const double x = normal(deviation), y = normal(deviation), z = normal(deviation);
    return {x, y, z};
  }

 private:
  double share() { return pdu::unit_of(engine_()); }
  std::mt19937_64 engine_;
};

/// The samples of all display frames, from a function of time.
template <typename At>
Track sampled(double seconds, At&& at) {
  Track track;
  const auto count = static_cast<std::size_t>(std::floor(seconds * kMotionRate + 1e-9)) + 1;
  track.samples.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double time = static_cast<double>(i) / kMotionRate;
    MotionSample sample = at(time);
    sample.time = time;
    track.samples.push_back(sample);
  }
  return track;
}

/// Yaw anticlockwise from x, pitch up, roll to the right, and their rates.
struct Attitude {
  double yaw = 0, pitch = 0, roll = 0;
  double yaw_rate = 0, pitch_rate = 0, roll_rate = 0;
};

void set_attitude(MotionSample& sample, const Attitude& a) {
  // Half a turn about x takes z up to z down.
  sample.orientation = AngleAxisd(a.yaw, Vector3d::UnitZ()) * AngleAxisd(kPi, Vector3d::UnitX()) *
                       AngleAxisd(a.pitch, Vector3d::UnitY()) *
                       AngleAxisd(a.roll, Vector3d::UnitX());
  const double turn = -a.yaw_rate;  // about the axis that points down
  sample.angular_velocity = {
      a.roll_rate - turn * std::sin(a.pitch),
      a.pitch_rate * std::cos(a.roll) + turn * std::sin(a.roll) * std::cos(a.pitch),
      turn * std::cos(a.roll) * std::cos(a.pitch) - a.pitch_rate * std::sin(a.roll)};
}

/// Body x along a level path.
void head_along_path(MotionSample& sample) {
  const Vector3d& v = sample.velocity;
  const Vector3d& a = sample.acceleration;
  Attitude attitude;
  attitude.yaw = std::atan2(v.y(), v.x());
  attitude.yaw_rate = (v.x() * a.y() - v.y() * a.x()) / v.head<2>().squaredNorm();
  set_attitude(sample, attitude);
}

Track straight(double seconds, std::uint64_t) {
  return sampled(seconds, [](double t) {
    MotionSample s;
    s.velocity = {20, 0, 0};
    s.position = s.velocity * t;
    set_attitude(s, {});
    return s;
  });
}

Track circle(double seconds, std::uint64_t) {
  static constexpr double kRadius = 100, kRate = 0.2;
  return sampled(seconds, [](double t) {
    MotionSample s;
    const Vector3d out{std::cos(kRate * t), std::sin(kRate * t), 0};
    s.position = kRadius * out;
    s.velocity = kRadius * kRate * Vector3d(-out.y(), out.x(), 0);
    s.acceleration = -kRadius * kRate * kRate * out;
    head_along_path(s);
    return s;
  });
}

Track weave(double seconds, std::uint64_t) {
  static constexpr double kSize = 5, kRate = 2, kSpeed = 20;
  return sampled(seconds, [](double t) {
    MotionSample s;
    s.position = {kSpeed * t, kSize * std::sin(kRate * t), 0};
    s.velocity = {kSpeed, kSize * kRate * std::cos(kRate * t), 0};
    s.acceleration = {0, -kSize * kRate * kRate * std::sin(kRate * t), 0};
    head_along_path(s);
    return s;
  });
}

/// A section of level motion with a constant change of speed or of heading, not both.
struct Stretch {
  double seconds;
  double acceleration;  ///< along the path [m/s^2]
  double turn;          ///< [rad/s], anticlockwise
};

/// A vehicle on the ground at the start of a section.
struct Ground {
  Vector3d position = Vector3d::Zero();
  double speed = 0, heading = 0;
};

/// Motion `t` seconds into a section: a parabola in time along a line, or an arc.
MotionSample on_stretch(const Ground& begin, const Stretch& stretch, double t) {
  MotionSample s;
  const double heading = begin.heading + stretch.turn * t;
  const double speed = begin.speed + stretch.acceleration * t;
  const Vector3d forward{std::cos(heading), std::sin(heading), 0};
  const Vector3d left{-forward.y(), forward.x(), 0};
  const double half = stretch.turn * t / 2;
  const double chord = stretch.turn == 0 ? t * (begin.speed + stretch.acceleration * t / 2)
                                         : 2 * begin.speed / stretch.turn * std::sin(half);
  const double way = begin.heading + half;
  s.position = begin.position + chord * Vector3d(std::cos(way), std::sin(way), 0);
  s.velocity = speed * forward;
  s.acceleration = stretch.acceleration * forward + speed * stretch.turn * left;
  Attitude attitude;
  attitude.yaw = heading;
  attitude.yaw_rate = stretch.turn;
  set_attitude(s, attitude);
  return s;
}

Track drive(double seconds, Ground ground, const std::vector<Stretch>& stretches) {
  std::size_t now = 0;
  double begin = 0;
  return sampled(seconds, [&](double t) {
    while (now + 1 < stretches.size() && t - begin >= stretches[now].seconds) {
      const Stretch& done = stretches[now++];
      ground.position = on_stretch(ground, done, done.seconds).position;
      ground.speed += done.acceleration * done.seconds;
      ground.heading += done.turn * done.seconds;
      begin += done.seconds;
    }
    return on_stretch(ground, stretches[now], t - begin);
  });
}

Track stop_and_go(double seconds, std::uint64_t seed) {
  Draw draw(seed);
  std::vector<Stretch> stretches;
  for (double covered = 0; covered <= seconds;) {
    const double away = draw.between(4, 7), brake = 3.5, go = 2;
    for (const Stretch& stretch :
         {Stretch{draw.between(2, 8), 0, 0}, Stretch{away, go, 0},
          Stretch{draw.between(3, 9), 0, 0}, Stretch{go * away / brake, -brake, 0}}) {
      stretches.push_back(stretch);
      covered += stretch.seconds;
    }
  }
  return drive(seconds, {}, stretches);
}

Track corners(double seconds, std::uint64_t seed) {
  Draw draw(seed);
  std::vector<Stretch> stretches;
  for (double covered = 0; covered <= seconds; covered += 0.5 + stretches.back().seconds) {
    const double side = draw.between(-1, 1) < 0 ? -1 : 1;
    stretches.push_back({0.5, 0, side * draw.between(0.6, 1.0) * kPi});
    stretches.push_back({draw.between(2, 4), 0, 0});
  }
  Ground ground;
  ground.speed = 10;
  return drive(seconds, ground, stretches);
}

/// One sine of a position, with its first three derivatives.
struct Wave {
  double value, rate, second, third;
};
Wave wave(double size, double omega, double t) {
  const double s = std::sin(omega * t), c = std::cos(omega * t);
  return {size * s, size * omega * c, -size * omega * omega * s, -size * omega * omega * omega * c};
}

/// Nose along the path, banked so that lift and weight produce the turn.
Attitude coordinated(const Wave& x, const Wave& y, const Wave& z) {
  const double level2 = x.rate * x.rate + y.rate * y.rate, level = std::sqrt(level2);
  const double level_rate = (x.rate * x.second + y.rate * y.second) / level;
  const double cross = x.rate * y.second - y.rate * x.second;
  const double cross_rate = x.rate * y.third - y.rate * x.third;
  Attitude a;
  a.yaw = std::atan2(y.rate, x.rate);
  a.yaw_rate = cross / level2;
  a.pitch = std::atan2(z.rate, level);
  a.pitch_rate = (z.second * level - z.rate * level_rate) / (level2 + z.rate * z.rate);
  // Sideways acceleration over weight; anticlockwise is to the left.
  const double share = -cross / level / kGravity;
  const double share_rate = -(cross_rate - cross * level_rate / level) / level / kGravity;
  a.roll = std::atan(share);
  a.roll_rate = share_rate / (1 + share * share);
  return a;
}

Track aircraft(double seconds, std::uint64_t) {
  static constexpr double kLap = 90;
  return sampled(seconds, [](double t) {
    const double omega = 2 * kPi / kLap;
    const Wave x = wave(2000, omega, t), y = wave(1000, 2 * omega, t), z = wave(200, 3 * omega, t);
    MotionSample s;
    s.position = {x.value, y.value, 3000 + z.value};
    s.velocity = {x.rate, y.rate, z.rate};
    s.acceleration = {x.second, y.second, z.second};
    set_attitude(s, coordinated(x, y, z));
    return s;
  });
}

Track hover(double seconds, std::uint64_t seed) {
  Draw draw(seed);
  return sampled(seconds, [&](double) {
    MotionSample s;
    s.position = {0, 0, 50};
    set_attitude(s, {});
    s.velocity = draw.normal3(0.05);
    s.acceleration = draw.normal3(0.2);
    s.angular_velocity = draw.normal3(0.01);
    return s;
  });
}

/// Share of a reach that is complete at share u of its time (minimum jerk), and its derivatives by
/// u.
struct Reach {
  double done, rate, second;
};
Reach least_jerk(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return {u * u * u * (10 + u * (6 * u - 15)), u * u * (30 + u * (30 * u - 60)),
          u * (60 + u * (120 * u - 180))};
}

Track hand(double seconds, std::uint64_t seed) {
  static constexpr double kLength = 0.1;  // [m]
  Draw draw(seed);
  MotionSample rest;
  Vector3d way = Vector3d::Zero(), turn = Vector3d::Zero();
  double begin = 0, lasts = 1, pause = 0;
  return sampled(seconds, [&](double t) {
    while (t - begin >= lasts + pause) {
      rest.position += way;
      rest.orientation = (rest.orientation * deadreckon::exponential(turn)).normalized();
      begin += lasts + pause;
      // Reverses the direction towards the middle of the workspace if the hand would leave it.
      way = kLength * draw.normal3(1).normalized();
      if (way.dot(rest.position) > 0 && rest.position.norm() > 0.15) way = -way;
      turn = draw.between(0.05, 0.4) * draw.normal3(1).normalized();
      lasts = draw.between(0.19, 0.6);  // 1.875 x 0.1 m / 0.19 s: up to 1 m/s
      pause = draw.between(0.1, 0.6);
    }
    const Reach reach = least_jerk((t - begin) / lasts);
    MotionSample s;
    s.position = rest.position + reach.done * way;
    s.velocity = reach.rate / lasts * way;
    s.acceleration = reach.second / (lasts * lasts) * way;
    s.orientation = rest.orientation * deadreckon::exponential(reach.done * turn);
    s.angular_velocity = reach.rate / lasts * turn;
    return s;
  });
}

Track jump(double seconds, std::uint64_t) {
  static constexpr double kSpeed = 5, kEvery = 7, kFar = 50;
  return sampled(seconds, [](double t) {
    MotionSample s;
    s.position = {kSpeed * t, kFar * std::floor(t / kEvery), 0};
    s.velocity = {kSpeed, 0, 0};
    set_attitude(s, {});
    return s;
  });
}

/// The acceleration follows from the velocities of successive samples, as an owner computes it: at
/// the sample of a bounce it is hundreds of m/s^2.
Track bounce(double seconds, std::uint64_t seed) {
  static constexpr double kKept = 0.8, kSlow = 1;
  Draw draw(seed);
  const auto thrown = [&] {
    const double x = draw.between(-2, 2), y = draw.between(-2, 2), z = draw.between(3, 7);
    return Vector3d(x, y, z);
  };
  Vector3d from = Vector3d::Zero(), velocity = thrown(), before = velocity;
  double begin = 0;
  return sampled(seconds, [&](double t) {
    bool bounces = false;
    for (double flight = 0; t - begin >= (flight = 2 * velocity.z() / kGravity); bounces = true) {
      from += flight * Vector3d(velocity.x(), velocity.y(), 0);
      begin += flight;
      velocity.z() *= kKept;
      if (velocity.z() < kSlow) velocity = thrown();
    }
    MotionSample s;
    const Vector3d fall(0, 0, -kGravity);
    s.position = from + (t - begin) * velocity + (t - begin) * (t - begin) / 2 * fall;
    s.velocity = velocity + (t - begin) * fall;
    s.acceleration = bounces ? Vector3d((s.velocity - before) * kMotionRate) : fall;
    before = s.velocity;
    set_attitude(s, {});
    return s;
  });
}

constexpr std::array<double, 6> kWalker{0.05, 0.1, 0.2, 0.5, 1, 2};
constexpr std::array<double, 6> kVehicle{0.1, 0.2, 0.5, 1, 2, 5};
constexpr std::array<double, 6> kHand{0.0005, 0.001, 0.0025, 0.005, 0.01, 0.02};

constexpr std::array kMotions{
    Motion{"straight", "20 m/s along a line", kVehicle, straight},
    Motion{"circle", "100 m radius at 20 m/s, heading along the path", kVehicle, circle},
    Motion{"weave", "20 m/s, 5 m to either side at 2 rad/s", kVehicle, weave},
    Motion{"stop_and_go", "traffic: waits, 2 m/s^2 up to 14 m/s, brakes at 3.5 m/s^2", kVehicle,
           stop_and_go},
    Motion{"corners", "10 m/s, turns of 54 to 90 degrees within half a second", kWalker, corners},
    Motion{"aircraft", "figure of eight at 140 to 200 m/s, climbing, banked up to 63 degrees",
           kVehicle, aircraft},
    Motion{"hover", "at rest, with noise on the sent rates", kWalker, hover},
    Motion{"hand", "reaches of 10 cm at up to 1 m/s, with pauses", kHand, hand},
    Motion{"jump", "5 m/s, moved by 50 m at once every 7 s", kVehicle, jump},
    Motion{"bounce", "a ball thrown at 3 to 7 m/s, bouncing; rates from its samples", kWalker,
           bounce},
};

}  // namespace

std::span<const Motion> motions() { return kMotions; }

}  // namespace reckon::bench
