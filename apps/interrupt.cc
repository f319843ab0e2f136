// SPDX-License-Identifier: BSD-3-Clause
#include "apps/interrupt.h"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <initializer_list>

namespace hexcal {
namespace {

enum State : int { kIdle, kPatient, kWriting, kLeaving };

std::atomic<int> state{kIdle};
std::atomic<int> pending_signal{0};
static_assert(std::atomic<int>::is_always_lock_free);  // or a signal handler could not use it

// First the signal is noted, then the state is looked at; ~WhileWriting does it the other way
// round, so that one of the two sees the other.
void OnSignal(int signal) {
  const bool is_first = pending_signal.exchange(signal) == 0;
  int expected = kIdle;
  if (state.compare_exchange_strong(expected, kLeaving)) _exit(128 + signal);
  expected = kPatient;
  if (!is_first && state.compare_exchange_strong(expected, kLeaving)) _exit(128 + signal);
}

// Another thread may be leaving: then this one never gets any further.
void Enter(State to, int from, int or_from, int* was) {
  for (;;) {
    for (const int before : {from, or_from}) {
      *was = before;
      if (state.compare_exchange_strong(*was, to)) return;
    }
    usleep(1000);
  }
}

void LeaveIfAsked() {
  const int signal = pending_signal;
  if (signal != 0) _exit(128 + signal);
}

}  // namespace

void CatchInterrupts() {
  // A file that may not grow is one that cannot be written: exit status 5, not the end of all.
  std::signal(SIGXFSZ, SIG_IGN);
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction action = {};
    if (sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN) continue;
    action = {};
    action.sa_handler = &OnSignal;
    action.sa_flags = SA_RESTART;
    sigaction(signal, &action, nullptr);
  }
}

WhileWriting::WhileWriting() {
  int was = kIdle;
  Enter(kWriting, kIdle, kPatient, &was);
  in_patient_work_ = was == kPatient;
}

WhileWriting::~WhileWriting() {
  state = in_patient_work_ ? kPatient : kIdle;
  if (!in_patient_work_) LeaveIfAsked();
}

PatientWork::PatientWork() {
  int was = kIdle;
  Enter(kPatient, kIdle, kIdle, &was);
}

PatientWork::~PatientWork() {
  state = kIdle;
  LeaveIfAsked();
}

bool PatientWork::IsInterrupted() { return pending_signal != 0; }

}  // namespace hexcal
