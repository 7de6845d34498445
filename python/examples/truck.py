# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""A truck that drives in a circle, fires once a second and tells who else fires: truck.py [IFACE [SECONDS]]"""
import math
import sys
import time

import reckon


def main() -> None:
    with reckon.Federate(reckon.Exercise(1, 47.05, 8.31), iface=(sys.argv[1:] or ["lo"])[0], name="TRUCK") as federate:
        truck = federate.own("TRUCK", type="1.1.206.7", force_id=1)
        federate.on(reckon.Fire, lambda fire, owns: print("received", fire.firing_entity_id, flush=True))
        for step in range(int(float((sys.argv[2:] or ["10"])[0]) * 50)):
            angle = 0.2 * step / 50  # 10 m/s on a circle of 50 m
            east, north = math.cos(angle), math.sin(angle)
            truck.move((50 * east, 50 * north, 0.0), velocity=(-10 * north, 10 * east, 0.0))
            if step % 50 == 49:
                x, y, z = federate.world((50 * east, 50 * north, 0.0))
                federate.send(reckon.Fire(firing_entity_id=reckon.EntityId(site=truck.id[0], application=truck.id[1], entity=truck.id[2]),
                                          location_in_world_coordinates=reckon.WorldCoordinates(x=x, y=y, z=z)))
            federate.tick()
            time.sleep(0.02)


main()
