// SPDX-License-Identifier: BSD-3-Clause
#include "apps/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <utility>

namespace hexcal {
namespace {

constexpr double kPatience = 2.0;  // s before the bar appears
constexpr double kRedraw = 0.1;    // s
constexpr long kBarWidth = 30;

Progress* visible_progress = nullptr;

std::string Bar(std::string_view label, long done, long total) {
  const long filled = kBarWidth * done / total;
  return fmt::format("\r{} [{:#<{}}{:.<{}}] {}/{}\x1b[K",
                     label.substr(0, 24),
                     "",
                     filled,
                     "",
                     kBarWidth - filled,
                     done,
                     total);
}

}  // namespace

ProgressScreen StandardErrorScreen() {
  ProgressScreen screen;
  screen.is_terminal = isatty(STDERR_FILENO) == 1;
  screen.seconds = [] {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double>(now).count();
  };
  screen.write = [](std::string_view text) {
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
  };
  return screen;
}

Progress::Progress(std::string label, bool quiet, ProgressScreen screen)
    : label_(std::move(label)),
      screen_(std::move(screen)),
      enabled_(screen_.is_terminal && !quiet),
      started_(screen_.seconds()) {}

Progress::~Progress() { Clear(); }

void Progress::Update(long done, long total) {
  if (!enabled_ || total <= 0) return;
  const double now = screen_.seconds();
  if (now - started_ <= kPatience || (visible_ && now - drawn_ < kRedraw)) return;
  screen_.write(Bar(label_, std::clamp(done, 0L, total), total));
  drawn_ = now;
  visible_ = true;
  visible_progress = this;
}

void Progress::ClearVisible() {
  if (visible_progress != nullptr) visible_progress->Clear();
}

void Progress::Clear() {
  if (!visible_) return;
  screen_.write("\r\x1b[K");
  visible_ = false;
  visible_progress = nullptr;
}

}  // namespace hexcal
