// SPDX-License-Identifier: BSD-3-Clause
// Nothing passes while the data ask for an effect that the model lacks (cli_audit_model_test has
// what passes once it is there).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "testing/run_program.h"
#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

using ::testing::HasSubstr;
using testing::ProgramResult;
using testing::RunHexcal;
using testing::TemporaryFolder;
using Json = nlohmann::json;

const std::string kHidden = std::string(HEXCAL_EXAMPLES) + "/hidden-effect/dataset.yaml";
constexpr const char* kRequirement =
    "format: hexcal/requirement/1\n"
    "units: {length: mm, angle: deg}\n"
    "points: [{name: tip, xyz: [0, 0, 100]}]\n"
    "robot: {position: 0.005, orientation: 0.002, from: assumed}\n"
    "requirements: [{name: wide, point: tip, over: poses, limit: 50}]\n";

class CliAuditMissing : public ::testing::Test {
 protected:
  Json Audit(const std::vector<std::string>& more) {
    std::vector<std::string> call = {"audit",
                                     kHidden,
                                     "--out=" + folder.Path("a"),
                                     "--requirement=" + folder.Write("r.yaml", kRequirement),
                                     "--draws=1000",
                                     "--force"};
    call.insert(call.end(), more.begin(), more.end());
    const ProgramResult run = RunHexcal({call});
    EXPECT_EQ(run.status, 0) << run.err;
    out = run.out;
    return Json::parse(folder.Read("a/hidden-effects-8/audit.json"));
  }

  TemporaryFolder folder;
  std::string out;
};

TEST_F(CliAuditMissing, KeepsEverythingFromPassingAndSaysWhatToDo) {
  const Json audit = Audit({});
  EXPECT_EQ(audit["verdict"], "INCONCLUSIVE");
  const Json& missing = audit["missing_effects"];
  ASSERT_EQ(missing["named"].size(), 1u);
  EXPECT_EQ(missing["tested"][0]["effect"], "base_drift");
  EXPECT_EQ(missing["tested"][0]["verdict"], "named");
  EXPECT_EQ(missing["tested"][1]["verdict"], "not named");
  EXPECT_LT(missing["tested"][0]["p_value"], 1e-6);
  EXPECT_EQ(missing["tested"][0]["points"][0]["point"], "tip");
  EXPECT_EQ(missing["poses"], 72);
  EXPECT_THAT(audit["requirements"][0]["reason"].get<std::string>(),
              HasSubstr("what the model lacks: base_drift (hexcal discover"));
  EXPECT_THAT(out, HasSubstr("base_drift"));
  const std::string page = folder.Read("a/hidden-effects-8/report.html");
  EXPECT_THAT(page, HasSubstr("<h2>Missing effects</h2>"));
  EXPECT_THAT(page, HasSubstr("<td>base_drift</td><td>named</td>"));
}

// The first poses of a dataset that keeps each pose's number in the first column of its tables.
std::string FirstPoses(const std::string& example, int poses, const TemporaryFolder& folder) {
  for (const char* table : {"poses.csv", "markers.csv"}) {
    std::ifstream all(example + "/" + table);
    std::string kept, line;
    while (std::getline(all, line))
      if (std::atoi(line.c_str()) <= poses) kept += line + "\n";
    folder.Write(table, kept);
  }
  std::ostringstream dataset;
  dataset << std::ifstream(example + "/dataset.yaml").rdbuf();
  return folder.Write("dataset.yaml", dataset.str());
}

TEST_F(CliAuditMissing, ThreePosesAreTooFewToTellAndSoToPass) {
  const std::string example = std::string(HEXCAL_EXAMPLES) + "/neurobot";
  for (const int poses : {3, 6}) {
    const ProgramResult run = RunHexcal({{"audit",
                                          FirstPoses(example, poses, folder),
                                          "--out=" + folder.Path("a"),
                                          "--requirement=" + folder.Write("r.yaml", kRequirement),
                                          "--draws=1000",
                                          "--force"}});
    EXPECT_EQ(run.status, 0) << run.err;
    const Json audit = Json::parse(folder.Read("a/neurobot/audit.json"));
    const std::string page = folder.Read("a/neurobot/report.html");
    const std::string why = "3 poses are too few to tell an effect from the noise";
    EXPECT_EQ(audit["verdict"], poses == 3 ? "INCONCLUSIVE" : "PASS");
    EXPECT_EQ(page.find(why) != std::string::npos, poses == 3);
  }
}

}  // namespace
}  // namespace hexcal
