// SPDX-License-Identifier: BSD-3-Clause
#include "apps/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <utility>

namespace hexcal {
namespace {

constexpr double kPatience = 2.0;  // s before the bar appears
constexpr double kRedraw = 0.1;    // s
constexpr long kBarWidth = 30;

Progress* visible_progress = nullptr;

// 5 s, 2:05 min, 3:20 h; never "0 s" of what is still to be done.
std::string Duration(double seconds) {
  const long s = std::max(1L, std::lround(seconds));
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{}:{:02} min", s / 60, s % 60);
  return fmt::format("{}:{:02} h", s / 3600, s / 60 % 60);
}

// ", 12/s, 5 s left", as the work went so far; nothing before the first is done.
std::string Pace(long done, long total, double seconds) {
  if (done <= 0 || done >= total || !(seconds > 0.0)) return "";
  const double rate = static_cast<double>(done) / seconds;
  const std::string rate_text = rate >= 1.0        ? fmt::format("{:.3g}/s", rate)
                                : rate >= 1 / 60.0 ? fmt::format("{:.2g}/min", 60.0 * rate)
                                                   : fmt::format("{:.2g}/h", 3600.0 * rate);
  return fmt::format(
      ", {}, {} left", rate_text, Duration(static_cast<double>(total - done) / rate));
}

std::string Bar(std::string_view label, long done, long total, double seconds) {
  const long filled = kBarWidth * done / total;
  return fmt::format("\r{} [{:#<{}}{:.<{}}] {}/{}{}\x1b[K",
                     label.substr(0, 24),
                     "",
                     filled,
                     "",
                     kBarWidth - filled,
                     done,
                     total,
                     Pace(done, total, seconds));
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
  screen_.write(Bar(label_, std::clamp(done, 0L, total), total, now - started_));
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
