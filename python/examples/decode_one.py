# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Makes one PDU, decodes it, changes it, encodes it: decode_one.py [HEX_DIGITS]"""
import sys

import reckon


def main() -> None:
    if len(sys.argv) > 1:
        octets = bytes.fromhex(sys.argv[1])
    else:
        fire = reckon.Fire(firing_entity_id=reckon.EntityId(site=1, application=2, entity=3), range=900.0)
        octets = reckon.encode(fire)
    pdu = reckon.decode(octets)
    print(pdu)
    pdu.header.exercise_id = 7
    print(reckon.encode(pdu).hex())


main()
