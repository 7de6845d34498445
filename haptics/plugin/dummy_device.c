/* SPDX-FileCopyrightText: 2026 The Reckon authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A driver as device_plugin.h wants it, of a device that is not there: a handle of 0.1 kg with friction, which a spring draws to a place. Copy it, and
 * put your device's calls in the place of step().
 *
 *   cc -shared -fPIC -o dummy_device.so dummy_device.c
 *   reckon demo scenes/stiff_wall.toml --device ./dummy_device.so
 *
 * Options: a place "x y z" [m] to which the spring draws, "0 0 0" if there is none. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "reckon/haptics/plugin/device_plugin.h"

#define MASS 0.1            /* [kg] */
#define DAMPING 1.0         /* [N s/m], of the handle: sure, for it is computed */
#define SPRING 200.0        /* [N/m], of the hand */
#define GRIP 3.0            /* [N s/m] */
#define MOST 10.0           /* [N] */
#define WATCHDOG 10000000LL /* [ns] */
#define SUBSTEP 1e-4        /* [s] */

typedef struct {
  double place[3], velocity[3], drawn_to[3];
  double force[3];
  int64_t now, written;
  int started, let_go;
  double released_at[3];
} dummy;

static void* open_dummy(const char* options, char* error, size_t error_size) {
  double p[3] = {0, 0, 0};
  char rest;
  if (options[0] != '\0' && sscanf(options, "%lf %lf %lf %c", &p[0], &p[1], &p[2], &rest) != 3) {
    snprintf(error, error_size, "options are a place, such as \"0 0 0.05\" in metres, not \"%s\"", options);
    return NULL;
  }
  dummy* d = calloc(1, sizeof *d);
  if (d == NULL) {
    snprintf(error, error_size, "there is no memory for it");
    return NULL;
  }
  memcpy(d->drawn_to, p, sizeof p);
  memcpy(d->place, p, sizeof p);
  return d;
}

static void limits_of_dummy(void* device, reckon_device_limits* out) {
  (void)device;
  out->axes = 3;
  out->max_force = MOST;
  out->damping = DAMPING;
  out->max_speed = 2.0;
  for (int i = 0; i < 3; ++i) {
    out->workspace_min[i] = -0.2;
    out->workspace_max[i] = 0.2;
  }
}

/* Where a driver of a real device would ask it. */
static void step(dummy* d, double seconds) {
  while (seconds > 0) {
    const double h = seconds < SUBSTEP ? seconds : SUBSTEP;
    for (int i = 0; i < 3; ++i) {
      const double hand = SPRING * (d->drawn_to[i] - d->place[i]) - GRIP * d->velocity[i];
      d->velocity[i] += h / MASS * (hand + d->force[i] - DAMPING * d->velocity[i]);
      d->place[i] += h * d->velocity[i];
    }
    seconds -= h;
  }
}

static int read_dummy(void* device, int64_t now, reckon_device_reading* out) {
  dummy* d = device;
  if (!d->started) {
    d->started = 1;
    d->now = d->written = now;
  }
  /* A force that nobody renews is none. */
  const int64_t end = d->written + WATCHDOG;
  const int holds = d->force[0] != 0 || d->force[1] != 0 || d->force[2] != 0;
  if (holds && now > end) {
    step(d, 1e-9 * (double)(end - d->now));
    memset(d->force, 0, sizeof d->force);
    memcpy(d->released_at, d->place, sizeof d->place);
    d->let_go = 1;
    d->now = end;
  }
  step(d, 1e-9 * (double)(now - d->now));
  d->now = now;
  memcpy(out->position, d->place, sizeof d->place);
  memcpy(out->velocity, d->velocity, sizeof d->velocity);
  out->flags = RECKON_DEVICE_HAS_VELOCITY;
  if (d->let_go) {
    out->flags |= RECKON_DEVICE_LET_GO | RECKON_DEVICE_RELEASED_AT;
    memcpy(out->released_at, d->released_at, sizeof d->released_at);
    d->let_go = 0;
  }
  return 0;
}

static void write_dummy(void* device, int64_t now, const double force[3], const double torque[3]) {
  dummy* d = device;
  (void)torque;
  for (int i = 0; i < 3; ++i) d->force[i] = force[i] > MOST ? MOST : force[i] < -MOST ? -MOST : force[i];
  d->written = now;
}

static void close_dummy(void* device) { free(device); }

const reckon_device_driver* reckon_device_driver_table(void) {
  static const reckon_device_driver driver = {
      RECKON_DEVICE_ABI, sizeof(reckon_device_driver), "dummy", open_dummy, limits_of_dummy, read_dummy, write_dummy, close_dummy};
  return &driver;
}
