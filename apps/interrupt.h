// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace hexcal {

// From here on SIGINT and SIGTERM end the program with 128 + the signal's number (130, 143), but
// never while a file is being written. A signal that the caller chose to ignore stays ignored.
void CatchInterrupts();

// While one stands, an interrupt waits; it is carried out at the end. Do not nest.
class WhileWriting {
 public:
  WhileWriting();
  ~WhileWriting();
  WhileWriting(const WhileWriting&) = delete;
  WhileWriting& operator=(const WhileWriting&) = delete;
};

}  // namespace hexcal
