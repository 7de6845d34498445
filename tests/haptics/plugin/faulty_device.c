/* SPDX-FileCopyrightText: 2026 The Reckon authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A driver that is wrong in the way that its options name, or, by its name as compiled, as a whole. */
#include <math.h>
#include <string.h>
#include <time.h>

#include "reckon/haptics/plugin/device_plugin.h"

static char fault[32];
static int opened, closed;

static int is(const char* name) { return strcmp(fault, name) == 0; }

static void* open_it(const char* options, char* error, size_t error_size) {
  strncpy(fault, options, sizeof fault - 1);
  if (is("mute")) return NULL;
  if (is("chatty")) memset(error, 'x', error_size);
  if (is("chatty")) return NULL;
  ++opened;
  return fault;
}

static void limits_of_it(void* device, reckon_device_limits* out) {
  (void)device;
  out->axes = is("axes") ? 5 : is("turned") ? 6 : 3;
  out->delay_samples = is("delay") ? -1 : 0;
  out->max_force = is("force") ? NAN : 5.0;
  out->damping = is("damping") ? -1.0 : 1.0;
  out->max_speed = is("speed") ? 0.0 : 2.0;
  out->resolution = is("resolution") ? INFINITY : 0.0;
  for (int i = 0; i < 3; ++i) {
    out->workspace_min[i] = -1;
    out->workspace_max[i] = is("space") ? -1 : 1;
  }
  out->max_torque = 1.0;
  out->turn_damping = 0.01;
}

static int read_it(void* device, int64_t now, reckon_device_reading* out) {
  (void)device;
  (void)now;
  if (is("silent")) return -1;
  if (is("place")) out->position[1] = NAN;
  if (is("speeds")) {
    out->velocity[2] = INFINITY;
    out->flags = RECKON_DEVICE_HAS_VELOCITY;
  }
  if (is("slow")) {
    const struct timespec wait = {0, 2000000};
    nanosleep(&wait, NULL);
  }
  out->buttons = 5;
  return 0; /* of six axes: no orientation */
}

static void write_it(void* device, int64_t now, const double force[3], const double torque[3]) {
  (void)device;
  (void)now;
  (void)force;
  (void)torque;
}

static void close_it(void* device) {
  (void)device;
  ++closed;
}

/* How many are open, for the test. */
int left_open(void) { return opened - closed; }

#ifndef NO_TABLE
const reckon_device_driver* reckon_device_driver_table(void) {
#ifdef OTHER_ABI
  static const reckon_device_driver driver = {RECKON_DEVICE_ABI + 1, sizeof(reckon_device_driver), "faulty", open_it, limits_of_it, read_it, write_it, close_it};
#elif defined(HALF_TABLE)
  static const reckon_device_driver driver = {RECKON_DEVICE_ABI, sizeof(reckon_device_driver), "faulty", open_it, limits_of_it, read_it, NULL, close_it};
#else
  static const reckon_device_driver driver = {RECKON_DEVICE_ABI, sizeof(reckon_device_driver), "faulty", open_it, limits_of_it, read_it, write_it, close_it};
#endif
  return &driver;
}
#endif
