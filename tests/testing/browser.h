// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unistd.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "testing/run_program.h"

namespace hexcal::testing {

// A Chromium without a window, as installed by scripts/install_dependencies test.
class Browser {
 public:
  bool IsThere() const { return !Program().empty(); }

  // What has become of the page after its scripts have run, as HTML.
  std::string Dom(const std::string& html) { return Open(html, {"--dump-dom"}); }

  // The page in a frame so many px wide (a window cannot be as narrow as a telephone), with this
  // script beside it, which may look into the frame with the id "framed". The page is written into
  // the frame, not fetched: its own time would run out while a busy browser still fetches.
  std::string FramedDom(const std::string& html, int width, const std::string& script) {
    const std::string text = std::regex_replace(
        nlohmann::json(html).dump(-1, ' ', /*ensure_ascii=*/true), std::regex("<"), "\\u003c");
    return Open("<iframe id=\"framed\" height=\"900\" width=\"" + std::to_string(width) +
                    "\"></iframe>\n<script>const inside = document.getElementById(\"framed\")"
                    ".contentDocument; inside.open(); inside.write(" +
                    text + "); inside.close();</script>\n<script>" + script + "</script>",
                {"--dump-dom"});
  }

  // The page on paper: the bytes of a PDF.
  std::string Pdf(const std::string& html) {
    Open(html, {"--print-to-pdf=" + folder_.Path("page.pdf"), "--no-pdf-header-footer"});
    return folder_.Read("page.pdf");
  }

  // What the last page said on the console: errors, refusals by its policy, requests that failed.
  const std::vector<std::string>& Console() const { return console_; }

 private:
  static std::string Program() {
    for (const char* program :
         {"/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"})
      if (access(program, X_OK) == 0) return program;
    return "";
  }

  // Offline: no host has an address, so that every request of the page fails and is told.
  std::string Open(const std::string& html, const std::vector<std::string>& more) {
    ProgramRun run;
    run.arguments = {"--headless",
                     "--no-sandbox",
                     "--disable-gpu",
                     "--enable-unsafe-swiftshader",
                     "--no-first-run",
                     "--disable-background-networking",
                     "--disable-component-update",
                     "--disable-sync",
                     "--disable-dev-shm-usage",
                     "--host-resolver-rules=MAP * ~NOTFOUND",
                     "--user-data-dir=" + folder_.Path("profile"),
                     "--enable-logging=stderr",
                     "--v=0",
                     // In the page's own time, which stands still while it works: each picture may
                     // wait a second of it for a browser that calls itself busy, so that the time
                     // has to be enough for a hundred of them, however busy the machine is.
                     "--virtual-time-budget=100000"};
    run.arguments.insert(run.arguments.end(), more.begin(), more.end());
    run.arguments.push_back("file://" + folder_.Write("page.html", html));
    run.environment = {{"HOME", folder_.Path("")}};
    const ProgramResult result = RunProgram(Program(), run);
    console_.clear();
    std::istringstream lines(result.err);
    for (std::string line; std::getline(lines, line);)
      if (line.find(":CONSOLE:") != std::string::npos) console_.push_back(line);
    EXPECT_EQ(result.status, 0) << result.err;
    return result.out;
  }

  TemporaryFolder folder_;
  std::vector<std::string> console_;
};

}  // namespace hexcal::testing
