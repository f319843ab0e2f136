// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace hexcal {

// From here on SIGINT and SIGTERM end the program with 128 + the signal's number (130, 143), but
// never while a file is being written. A signal that the caller chose to ignore stays ignored.
// A limit on the size of files (ulimit -f) makes writing fail, as a full disk does.
void CatchInterrupts();

// While one stands, an interrupt waits; it is carried out at the end. Do not nest.
class WhileWriting {
 public:
  WhileWriting();
  ~WhileWriting();
  WhileWriting(const WhileWriting&) = delete;
  WhileWriting& operator=(const WhileWriting&) = delete;

 private:
  bool in_patient_work_;
};

// While one stands, a first interrupt is only noted: the work asks for it, finishes what it is at
// and ends. A second one does not wait. Whatever was noted is carried out at the end. One at a
// time; WhileWriting may stand within.
class PatientWork {
 public:
  PatientWork();
  ~PatientWork();
  PatientWork(const PatientWork&) = delete;
  PatientWork& operator=(const PatientWork&) = delete;

  static bool IsInterrupted();
};

}  // namespace hexcal
