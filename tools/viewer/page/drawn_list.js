// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The list of drawn things, in order. A new thing needs its file, and a row here:
//   { name, view: 'world' or 'touch', large: true if an inset is too small for it,
//     says: words of the key, mark: shape and colour of the key,
//     make(group, view, labels) -> { paint(), update(moment) } }
import { drawnGround } from './drawn_ground.js';
import { drawnCells } from './drawn_cells.js';
import { drawnBeacons } from './drawn_beacons.js';
import { drawnGroups, drawnContactGroups } from './drawn_groups.js';
import { drawnTrails } from './drawn_trails.js';
import { drawnGhosts } from './drawn_ghosts.js';
import { drawnEntities } from './drawn_entities.js';
import { drawnContacts } from './drawn_contacts.js';
import { drawnFollowed } from './drawn_followed.js';
import { drawnFloor } from './drawn_floor.js';
import { drawnDepth } from './drawn_depth.js';
import { drawnSolids } from './drawn_solids.js';
import { drawnOwners } from './drawn_owners.js';
import { drawnRegions } from './drawn_regions.js';
import { drawnPatches } from './drawn_patches.js';
import { drawnHandGhosts } from './drawn_hand_ghosts.js';
import { drawnHands } from './drawn_hands.js';
import { drawnTools } from './drawn_tools.js';
import { drawnTouchEntities } from './drawn_touch_entities.js';
import { drawnForces } from './drawn_forces.js';
import { drawnCones } from './drawn_cones.js';

export const DRAWN = [
  drawnGround, drawnCells, drawnBeacons, drawnTrails, drawnGhosts, drawnEntities, drawnContacts, drawnGroups, drawnContactGroups, drawnFollowed,
  drawnFloor, drawnDepth, drawnSolids, drawnOwners, drawnRegions, drawnPatches, drawnHandGhosts, drawnHands, drawnTools, drawnTouchEntities, drawnForces, drawnCones,
];
