// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "testing/cli_test.h"

namespace hexcal::testing {

inline const std::string kAudited = std::string(HEXCAL_EXAMPLES) + "/neurobot/";

// hexcal audit of examples/neurobot from outside, in a folder of its own.
class CliAudit : public CliTest {
 protected:
  ProgramResult Audit(const std::vector<std::string>& more) const {
    return Call({"audit", kAudited + "dataset.yaml", "--out=out", "--draws=1000", "--folds=2"},
                more);
  }

  std::string Read(const std::string& name) const { return folder.Read("out/neurobot/" + name); }

  // The bundled requirement with another limit, mm.
  std::string WithLimit(const std::string& limit) const {
    std::string text = Bundled();
    const std::string part = "limit: 0.5";
    text.replace(text.find(part), part.size(), "limit: " + limit);
    return folder.Write("r.yaml", text);
  }

  static std::string Bundled() {
    std::ostringstream content;
    content << std::ifstream(kAudited + "requirement.yaml").rdbuf();
    return content.str();
  }

  const std::string bundled = "--requirement=" + kAudited + "requirement.yaml";
};

}  // namespace hexcal::testing
