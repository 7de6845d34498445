/* SPDX-FileCopyrightText: 2026 The Reckon authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Stand-ins of what a sketch calls, so that one is compiled and run here. */
#pragma once

#include <stddef.h>
#include <stdint.h>

enum { INPUT_PULLUP = 2, OUTPUT = 1, CHANGE = 1 };

void pinMode(int pin, int mode);
int digitalRead(int pin);
void digitalWrite(int pin, int level);
void analogWrite(int pin, int duty);
int digitalPinToInterrupt(int pin);
void attachInterrupt(int interrupt, void (*call)(), int mode);
void noInterrupts();
void interrupts();
unsigned long micros();

struct SerialStub {
  void begin(unsigned long baud);
  int available();
  int read();
  size_t write(const uint8_t* octets, size_t length);
};
extern SerialStub Serial;

void setup();
void loop();
