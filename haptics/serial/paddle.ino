// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A paddle of one axis, as the Hapkit is: a motor drives a sector by a capstan, and an encoder with
// two channels is on the motor's shaft. For any board with two pins that interrupt. Numbers of the
// mechanics are examples: put in those of yours, and measure that the motor pulls as stated.
#include "reckon_board.h"

const int kChannelA = 2, kChannelB = 3, kForward = 7, kBackward = 8, kPulse = 9;
const float kMetresPerCount = 14.7e-6;  // at the handle
const float kNewtonsAtFullPulse = 3.0;  // at the handle, of the whole supply
const uint16_t kPeriod = 1000;          // [us]

volatile long count = 0;
reckon_board board;
uint32_t next_tick;

void on_edge() {
  static uint8_t before = 0;
  const uint8_t now = (uint8_t)(digitalRead(kChannelA) << 1 | digitalRead(kChannelB));
  // Both change, or none: an edge was missed, and which way is not known.
  static const int8_t kSteps[16] = {0, 1, -1, 0, -1, 0, 0, 1, 1, 0, 0, -1, 0, -1, 1, 0};
  count = count + kSteps[before << 2 | now];
  before = now;
}

void write_line(void*, const uint8_t* octets, uint8_t length) { Serial.write(octets, length); }

void drive(int16_t force) {
  const long pulse = (long)(255 * 1e-3 / kNewtonsAtFullPulse * force);
  digitalWrite(kForward, pulse > 0);
  digitalWrite(kBackward, pulse < 0);
  analogWrite(kPulse, pulse < 0 ? -pulse : pulse);
}

void setup() {
  pinMode(kChannelA, INPUT_PULLUP);
  pinMode(kChannelB, INPUT_PULLUP);
  pinMode(kForward, OUTPUT);
  pinMode(kBackward, OUTPUT);
  pinMode(kPulse, OUTPUT);
  attachInterrupt(digitalPinToInterrupt(kChannelA), on_edge, CHANGE);
  attachInterrupt(digitalPinToInterrupt(kChannelB), on_edge, CHANGE);
  board.name = "Paddle";
  board.axes = 1;
  board.axis[0].direction = 0;
  board.axis[0].nm_per_count = (int32_t)(1e9 * kMetresPerCount);
  board.axis[0].most_force = (uint16_t)(1e3 * kNewtonsAtFullPulse);
  board.watchdog = 10;
  board.period = kPeriod;
  board.write = write_line;
  Serial.begin(1000000);
  next_tick = micros();
}

// The handle is in the middle when the board is switched on: counts begin at 0.
void loop() {
  while (Serial.available() > 0) reckon_board_take(&board, (uint8_t)Serial.read());
  if ((int32_t)((uint32_t)micros() - next_tick) < 0) return;
  next_tick += kPeriod;
  noInterrupts();
  const int32_t counts[1] = {(int32_t)count};
  interrupts();
  int16_t force[1];
  reckon_board_tick(&board, micros(), counts, 0, 1, force);
  drive(force[0]);
}
