/* SPDX-FileCopyrightText: 2026 The Reckon authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The board's side of a serial line to Reckon (docs/devices.md, "A serial board"): C99 and C++11,
 * no heap, no library, some 250 octets of memory. Copy it beside your sketch; paddle.ino is one.
 *
 *     reckon_board_take(&board, octet);                    for each octet from the host
 *     reckon_board_tick(&board, micros(), counts, ..);     at a steady rate: it reports, and says
 * the forces to hold until the next tick
 *
 * The one rule that keeps the energy right: a force changes in a tick, at the instant at which the
 * counts were read, and at no other time.
 */
#ifndef RECKON_BOARD_H
#define RECKON_BOARD_H

#include <stdint.h>
#include <string.h>

#define RECKON_VERSION 1
#define RECKON_AXES 3  /* at most */
#define RECKON_NAME 32 /* letters of a name, at most */
#define RECKON_CARRIED 64

typedef struct {
  uint8_t direction;    /* 0: x, to the right; 1: y, away from the person; 2: z, up */
  int32_t nm_per_count; /* negative where greater counts are the other way */
  uint16_t most_force;  /* [mN] that this axis can hold for long */
} reckon_axis;

typedef struct {
  /* To be set, the rest to zero, before the first call. */
  const char* name; /* 1 to 32 printable letters */
  uint8_t axes;     /* 1 to 3 */
  reckon_axis axis[RECKON_AXES];
  uint8_t watchdog; /* [ms], 1 to 10: without a frame for so long the force is zero */
  uint16_t period;  /* [us] between ticks, 100 to 2000 */
  void (*write)(void* line, const uint8_t* octets, uint8_t length); /* to the host */
  void* line;

  /* Its own. */
  uint8_t in[RECKON_CARRIED + 3];
  uint8_t in_length;
  uint8_t is_asked;    /* since the host was last silent for a second */
  uint8_t has_frame;   /* a frame came since the last tick */
  uint8_t has_next;    /* a force that the next tick takes up */
  uint8_t drops;       /* the next tick drops the force */
  uint8_t holds;       /* a force of the host's */
  uint8_t force_drops; /* number of drops, modulo 16 in reports */
  uint16_t next_number, number;
  int16_t next_force[RECKON_AXES], force[RECKON_AXES];
  uint16_t sequence;
  uint32_t frame_at; /* [us] of the last frame */
} reckon_board;

static inline uint16_t reckon_crc(const uint8_t* octets, uint8_t length) {
  uint16_t crc = 0xFFFF;
  uint8_t i, bit, top;
  for (i = 0; i < length; ++i) {
    crc = (uint16_t)(crc ^ (uint16_t)((uint16_t)octets[i] << 8));
    for (bit = 0; bit < 8; ++bit) {
      top = (uint8_t)(crc >> 15);
      crc = (uint16_t)(crc << 1);
      if (top) crc = (uint16_t)(crc ^ 0x1021u);
    }
  }
  return crc;
}

static inline uint8_t* reckon_put(uint8_t* at, uint32_t number, uint8_t octets) {
  for (; octets > 0; --octets, number >>= 8) *at++ = (uint8_t)(number & 0xFFu);
  return at;
}

static inline uint16_t reckon_word(const uint8_t* at) {
  return (uint16_t)(at[0] | (uint16_t)((uint16_t)at[1] << 8));
}

/* COBS: a zero, then before each run of octets that are not zero how far the next zero would be,
 * then a zero. `carried` has room for the CRC. */
static inline void reckon_send(reckon_board* board, uint8_t* carried, uint8_t length) {
  uint8_t out[RECKON_CARRIED + 5];
  uint8_t code = 1, next = 2, i;
  length = (uint8_t)(reckon_put(carried + length, reckon_crc(carried, length), 2) - carried);
  out[0] = 0;
  for (i = 0; i < length; ++i) {
    if (carried[i] != 0) {
      out[next++] = carried[i];
    } else {
      out[code] = (uint8_t)(next - code);
      code = next++;
    }
  }
  out[code] = (uint8_t)(next - code);
  out[next++] = 0;
  board->write(board->line, out, next);
}

static inline void reckon_greet(reckon_board* board, uint16_t question) {
  uint8_t carried[RECKON_CARRIED + 2];
  uint8_t* at = carried;
  uint8_t i;
  at = reckon_put(at, 0x81, 1);
  at = reckon_put(at, RECKON_VERSION, 1);
  at = reckon_put(at, question, 2);
  at = reckon_put(at, board->axes, 1);
  at = reckon_put(at, board->watchdog, 1);
  at = reckon_put(at, board->period, 2);
  for (i = 0; i < board->axes; ++i) {
    at = reckon_put(at, board->axis[i].direction, 1);
    at = reckon_put(at, (uint32_t)board->axis[i].nm_per_count, 4);
    at = reckon_put(at, board->axis[i].most_force, 2);
  }
  for (i = 0; i < RECKON_NAME && board->name[i] != 0; ++i) *at++ = (uint8_t)board->name[i];
  reckon_send(board, carried, (uint8_t)(at - carried));
}

/* @param frame without its CRC */
static inline void reckon_obey(reckon_board* board, const uint8_t* frame, uint8_t length) {
  uint8_t i;
  if (length == 4 && frame[0] == 0x01) {
    board->is_asked = 1;
    board->has_frame = 1;
    board->has_next = 0;
    board->drops = 1;
    reckon_greet(board, reckon_word(frame + 2));
  } else if (length == 3 + 2 * board->axes && frame[0] == 0x02) {
    board->has_frame = 1;
    board->has_next = 1;
    board->next_number = reckon_word(frame + 1);
    for (i = 0; i < board->axes; ++i)
      board->next_force[i] = (int16_t)reckon_word(frame + 3 + 2 * i);
  }
}

/* Takes an octet from the host. A frame ends with a zero; what is damaged is dropped. */
static inline void reckon_board_take(reckon_board* board, uint8_t octet) {
  uint8_t frame[RECKON_CARRIED + 3];
  uint8_t length = 0, at = 0, end;
  if (octet != 0) {
    /* A full buffer is no frame: a length beyond it marks that. */
    if (board->in_length < sizeof board->in) board->in[board->in_length] = octet;
    if (board->in_length <= sizeof board->in) ++board->in_length;
    return;
  }
  while (at < board->in_length && board->in_length <= sizeof board->in) {
    end = (uint8_t)(at + board->in[at]);
    if (end > board->in_length || end <= at) break;
    for (++at; at < end; ++at) frame[length++] = board->in[at];
    if (at < board->in_length) frame[length++] = 0;
  }
  if (at == board->in_length && length > 2 &&
      reckon_crc(frame, (uint8_t)(length - 2)) == reckon_word(frame + length - 2))
    reckon_obey(board, frame, (uint8_t)(length - 2));
  board->in_length = 0;
}

/* Reports, and says what to hold from now on.
 * now: [us], which may come round. counts: read right now, 0 in the middle of the work space.
 * is_homed: whether they are places. force: [mN] of each axis, towards greater counts. */
static inline void reckon_board_tick(reckon_board* board, uint32_t now, const int32_t* counts,
                                     uint8_t buttons, uint8_t is_homed, int16_t* force) {
  uint8_t carried[RECKON_CARRIED + 2];
  uint8_t* at = carried;
  const uint8_t held = board->holds;
  const uint16_t until = board->number;
  uint8_t i, flags;

  if (board->has_frame) board->frame_at = now;
  board->has_frame = 0;
  if (board->drops) board->holds = 0;
  board->drops = 0;
  if (board->has_next) {
    board->holds = 1;
    board->number = board->next_number;
    memcpy(board->force, board->next_force, sizeof board->force);
  }
  board->has_next = 0;
  if (!is_homed || (uint32_t)(now - board->frame_at) >= 1000uL * board->watchdog) board->holds = 0;
  if (held && !board->holds) ++board->force_drops;
  if ((uint32_t)(now - board->frame_at) > 1000000uL) board->is_asked = 0;
  for (i = 0; i < board->axes; ++i) force[i] = board->holds ? board->force[i] : 0;
  if (!board->is_asked) return;

  flags = (uint8_t)((held ? 1 : 0) | (board->holds ? 2 : 0) | (is_homed ? 0 : 4) |
                    (uint8_t)(board->force_drops << 4));
  at = reckon_put(at, 0x82, 1);
  at = reckon_put(at, ++board->sequence, 2);
  at = reckon_put(at, now, 4);
  at = reckon_put(at, until, 2);
  at = reckon_put(at, board->number, 2);
  at = reckon_put(at, flags, 1);
  at = reckon_put(at, buttons, 1);
  for (i = 0; i < board->axes; ++i) at = reckon_put(at, (uint32_t)counts[i], 4);
  reckon_send(board, carried, (uint8_t)(at - carried));
}

#endif
