// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A truck that drives in a circle, prints the entities it receives, and stops when it is fired at.
#pragma once

#include <cmath>
#include <cstdio>
#include <functional>

#include "reckon/pdu/warfare/fire.hpp"
#include "reckon/peer/federate.hpp"

inline constexpr double kLatitude = 0.82118, kLongitude = 0.14503;  // [rad], 47.05 N 8.31 E

// Drives while `go_on()`, which waits a little between two steps.
inline void drive(reckon::peer::Federate& federate, const std::function<bool()>& go_on) {
  using namespace reckon;
  peer::EntityDescription truck;
  truck.marking = "TRUCK1";
  truck.type = {pdu::EntityKind::platform, pdu::EntityDomain::land, 206, 7, 0, 0, 0};
  truck.force_id = pdu::ForceId::friendly;
  federate.publish(peer::EntityClass{truck.type});
  federate.subscribe(peer::EntityClass{});  // everybody
  federate.on_discover([](const peer::RemoteObject& other) {
    std::printf("sees %s\n", std::string(other.marking()).c_str());
  });
  double speed = 10.0;  // [m/s]
  federate.subscribe<pdu::Fire>([&](const pdu::Fire& fire) {
    std::printf("hears %u:%u:%u fire\n", fire.firing_entity_id.site,
                fire.firing_entity_id.application, fire.firing_entity_id.entity);
    speed = 0.0;
  });

  const auto handle = federate.register_object(truck, federate.place(kLatitude, kLongitude, 430.0));
  const pdu::EntityId own = federate.id_of(handle);
  std::printf("is %u:%u:%u\n", own.site, own.application, own.entity);
  const double radius = 50.0;  // [m]
  double angle = 0.0;
  auto before = federate.now();
  while (go_on()) {
    const auto now = federate.now();
    angle += speed / radius * std::chrono::duration<double>(now - before).count();
    before = now;
    auto truth = federate.place(kLatitude, kLongitude, 430.0, -angle);
    truth.position += radius * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0);
    truth.velocity = speed * Eigen::Vector3d(-std::sin(angle), std::cos(angle), 0.0);
    federate.update_attributes(handle, truth);
    federate.step();
  }
}
