/* SPDX-FileCopyrightText: 2026 The Reckon authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The interface of a driver that Reckon loads: a shared library with one function,
 * reckon_device_driver_table(), that returns a table of functions. It is C, and everything in it stays as it is for
 * one RECKON_DEVICE_ABI. dummy_device.c is a whole driver.
 *
 * A driver gives the place of a handle and takes a force. open() and close() are called by the thread that starts and ends the peer. All others are
 * called by the servo thread, a thousand times a second, and must return within some microseconds: no lock that another thread may hold, no
 * allocation, no waiting for a line. A driver whose line is slower has a thread of its own, and hands over the newest reading and the newest
 * force. Units: m, s, N, rad. Axes: those of the device, right-handed.
 *
 * SAFETY. A force is held from write() until the next write(). If none comes for 10 ms the driver sets it to zero by itself, even if the program
 * has ended, and sets RECKON_DEVICE_LET_GO in the next reading. It limits each force to what the device can bear. `damping` is the viscous
 * friction of the handle that is CERTAIN, along each axis: the stiffness of walls follows from it, and a value above the real one makes the
 * device shake. */
#ifndef RECKON_HAPTICS_PLUGIN_DEVICE_PLUGIN_H
#define RECKON_HAPTICS_PLUGIN_DEVICE_PLUGIN_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A driver of another number is refused by name. */
#define RECKON_DEVICE_ABI 1u

/** What the device can do; fixed once it is open. */
typedef struct reckon_device_limits {
  int32_t axes;            /**< 3: a force; 6: it turns, and shows a torque too */
  int32_t delay_samples;   /**< writes after which a force is at the handle, >= 0 */
  double max_force;        /**< [N] > 0 */
  double max_stiffness;    /**< [N/m]; 0: no limit of its own */
  double damping;          /**< [N s/m] >= 0, sure */
  double max_speed;        /**< [m/s] > 0; faster is a fault */
  double resolution;       /**< [m] >= 0, step of its sensors; 0: exact */
  double workspace_min[3]; /**< [m] */
  double workspace_max[3]; /**< [m] */
  double max_torque;       /**< [N m] > 0, of 6 axes */
  double turn_damping;     /**< [N m s/rad] > 0, sure, of 6 axes */
  double turn_resolution;  /**< [rad] >= 0, of 6 axes */
} reckon_device_limits;

/** Flags of a reading. */
enum {
  RECKON_DEVICE_HAS_VELOCITY = 1, /**< `velocity` and `turn_rate` are measured */
  RECKON_DEVICE_DISABLED = 2,     /**< the operator's switch is not held: no force */
  RECKON_DEVICE_LET_GO = 4,       /**< it went to zero force by itself since the last reading */
  RECKON_DEVICE_RELEASED_AT = 8   /**< with LET_GO: `released_at` is where the handle was then */
};

/** One reading. All of it is zero before read(). */
typedef struct reckon_device_reading {
  double position[3];    /**< [m] */
  double velocity[3];    /**< [m/s] */
  double orientation[4]; /**< w, x, y, z: tool -> device, a unit quaternion; of 6 axes */
  double turn_rate[3];   /**< [rad/s], axes of the device */
  double released_at[3]; /**< [m] */
  double released_orientation[4];
  uint32_t flags;
  uint32_t buttons; /**< bit i: button i is pressed */
} reckon_device_reading;

/** A driver. It outlives all devices that it has opened. */
typedef struct reckon_device_driver {
  uint32_t abi;  /**< RECKON_DEVICE_ABI */
  uint32_t size; /**< sizeof(reckon_device_driver) */
  const char* name;

  /** Opens a device. `options` is what the scene says, UTF-8, "" if nothing.
   *  Returns the device; or NULL, with a sentence of what is wrong and the remedy in `error`, which
   *  has room for `error_size` characters and its end. */
  void* (*open)(const char* options, char* error, size_t error_size);
  /** Fills all limits. */
  void (*limits)(void* device, reckon_device_limits* out);
  /** Fills a reading; `now` [ns] never decreases. Returns 0; anything else: there is none this time. */
  int (*read)(void* device, int64_t now, reckon_device_reading* out);
  /** Force [N] and torque [N m] on the operator's hand, held until the next write. */
  void (*write)(void* device, int64_t now, const double force[3], const double torque[3]);
  /** Sets the force to zero and ends. */
  void (*close)(void* device);
} reckon_device_driver;

/** The one function of the library. */
const reckon_device_driver* reckon_device_driver_table(void);

#ifdef __cplusplus
}
#endif

#endif
