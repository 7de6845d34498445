// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/verbs/scene_template.hpp"

namespace reckon::tools {
namespace {

constexpr std::string_view kTemplate =
    R"(## A scene: touchable objects, hands and entities, network. Everything is optional.
## Check it:   reckon scene check FILE      Explain it:         reckon scene explain FILE
## All keys:   reckon scene keys            Lines with one '#' are examples: remove the '# '.

[scene]
name = "my scene"
origin = { latitude = "47.05 deg", longitude = "8.31 deg", height = "430 m" }

[[object]]
name = "table"
plane = [0, 0, 1]                                   # a half-space and its outward normal
surface = { stiffness = "900 N/m", damping = "0.2 N s/m" }
# friction = { static = 0.5, kinetic = 0.35 }       # only declared effects are simulated

## Other shapes: mesh, sphere, box, cylinder, cone, torus, ellipsoid; or a solid of parts.
# [[object]]
# name = "plate"
# part = [
#   { box = "80 60 10 mm" },
#   { operation = "subtract", cylinder = { radius = "10 mm", height = "5 cm" }, rounding = "2 mm" },
# ]

[hand]                                              # force model of a hand for other hands
radius = "10 mm"
k1 = "500 N/m"

[[operator]]                                        # one simulated hand each, for peers 1, 2 ...
sweep = { from = "-60 0 30 mm", to = "60 0 -5 mm", period = "4 s" }

## Without [[device]] each peer has one device. Otherwise only peers with a [[device]] have one.
# [[device]]
# peer = 1
# operator = 1
# position = "0 0 0 mm"                             # of the device's origin in S
# max_force = "10 N"
# damping = "1 N s/m"                               # viscous friction: more allows stiffer walls
# rate = "1 kHz"
# delay = "0 ms"                                    # from a command to its force at the handle

## Entities of a peer without a device.
# [[entity]]
# peer = 1
# marking = "POST"
# type = "Cultural feature Land"                    # or by number: "5.1"
# position = "20 0 0 cm"
# force_model = { kind = "sphere", radius = "30 mm", k1 = "400 N/m" }

# [[entity]]
# peer = 1
# marking = "TRUCK"
# type = "1.1.0.7"
# force_id = "friendly"
# place = { latitude = "47.05 deg", longitude = "8.3102 deg", height = "430 m" }
# heading = "90 deg"                                # clockwise from north
# dead_reckoning = { position = "1 m", angle = "3 deg" }
## track = "truck_track.csv"                        # t_s,px_m,py_m,pz_m beside this file

# [dead_reckoning]                                  # greatest errors of remote copies of hands
# position = "0.5 mm"
# force = "0.05 N"

# [aoim]                                            # cells, and the radius of reception
# cell = "1 m"
# radius = "2 m"

# [network]
# group = "239.192.1.0"
# port = 3000
)";

}  // namespace

std::string_view scene_template() noexcept { return kTemplate; }

}  // namespace reckon::tools
