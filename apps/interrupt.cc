// SPDX-License-Identifier: BSD-3-Clause
#include "apps/interrupt.h"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <initializer_list>

namespace hexcal {
namespace {

enum State : int { kIdle, kWriting, kLeaving };

std::atomic<int> state{kIdle};
std::atomic<int> pending_signal{0};
static_assert(std::atomic<int>::is_always_lock_free);  // or a signal handler could not use it

// First the signal is noted, then the state is looked at; ~WhileWriting does it the other way
// round, so that one of the two sees the other.
void OnSignal(int signal) {
  pending_signal = signal;
  int expected = kIdle;
  if (state.compare_exchange_strong(expected, kLeaving)) _exit(128 + signal);
}

}  // namespace

void CatchInterrupts() {
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
  int expected = kIdle;
  // Another thread may be leaving: then this one never gets any further.
  while (!state.compare_exchange_strong(expected, kWriting)) {
    expected = kIdle;
    usleep(1000);
  }
}

WhileWriting::~WhileWriting() {
  state = kIdle;
  const int signal = pending_signal;
  if (signal != 0) _exit(128 + signal);
}

}  // namespace hexcal
