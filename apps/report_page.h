// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "apps/output_folder.h"
#include "report/html/page.h"

namespace hexcal {

// report.html of a command, which is the kind of page that it writes.
inline OutputFile ReportPage(const std::string& command) {
  return {"report.html", HtmlPage::AnyMark(), command};
}

}  // namespace hexcal
