// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The list of plots, in order. A new plot needs its file, and a row here:
//   { name, title, unit, good: one plain sentence that says what to look for,
//     log: true for a logarithmic scale,
//     lines: [{ says, colour, dash: true, right: unit of a scale of its own,
//       twin: true if it shows a hidden twin,
//       brief: true if it alternates with others, at(moment): number or null }] }
import { plotForce } from './plot_force.js';
import { plotEnergy } from './plot_energy.js';
import { plotError } from './plot_error.js';
import { plotPackets } from './plot_packets.js';
import { plotDelay } from './plot_delay.js';

export const PLOTS = [plotForce, plotEnergy, plotError, plotPackets, plotDelay];
