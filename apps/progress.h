// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace hexcal {

// Where progress is shown. Tests bring their own.
struct ProgressScreen {
  bool is_terminal = false;
  std::function<double()> seconds;              // any steady clock
  std::function<void(std::string_view)> write;  // at once, unbuffered
};

ProgressScreen StandardErrorScreen();

// A bar on stderr with the rate and the time left, as it went so far; shown on a terminal once the
// work has taken more than two seconds, redrawn at most ten times a second and wiped at the end. To
// be used from one thread, one at a time.
class Progress {
 public:
  Progress(std::string label, bool quiet, ProgressScreen screen = StandardErrorScreen());
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void Update(long done, long total);

  // Wipes the bar that is on the screen, if any, before other text; the next Update redraws it.
  static void ClearVisible();

 private:
  void Clear();

  std::string label_;
  ProgressScreen screen_;
  bool enabled_;
  double started_;
  double drawn_ = 0.0;
  bool visible_ = false;
};

}  // namespace hexcal
