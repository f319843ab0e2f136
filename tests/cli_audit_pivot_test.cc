// SPDX-License-Identifier: BSD-3-Clause
// hexcal audit of a tip that hexcal pivot found, with what that pivoting leaves in doubt.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "testing/run_program.h"
#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

using ::hexcal::testing::ProgramResult;
using ::hexcal::testing::RunHexcal;
using ::hexcal::testing::TemporaryFolder;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

const std::string kExamples = HEXCAL_EXAMPLES;

class CliAuditPivot : public ::testing::Test {
 protected:
  // The bundled audit with the tip of the bundled pivoting, one reading of which slipped.
  Json AuditAfter(const std::vector<std::string>& of_pivot) const {
    std::vector<std::string> arguments = {
        "pivot", kExamples + "/pivot/pivoting.yaml", "--out=out", "--force", "--report"};
    arguments.insert(arguments.end(), of_pivot.begin(), of_pivot.end());
    EXPECT_EQ(RunHexcal({arguments, folder.Path("")}).status, 0);
    folder.Write("pivot.json", folder.Read("out/tool-tip/pivot.json"));
    std::ostringstream content;
    content << std::ifstream(kExamples + "/neurobot/requirement.yaml").rdbuf();
    std::string text = content.str();
    const std::string part = "xyz: [0, 0, 120], standard_deviation: 0.02";
    text.replace(text.find(part), part.size(), "pivot: pivot.json");
    const ProgramResult run = RunHexcal({{"audit",
                                          kExamples + "/neurobot/dataset.yaml",
                                          "--out=out",
                                          "--force",
                                          "--draws=1000",
                                          "--folds=2",
                                          "--requirement=" + folder.Write("r.yaml", text)},
                                         folder.Path("")});
    EXPECT_EQ(run.status, 0) << run.err;
    return Json::parse(folder.Read("out/neurobot/audit.json"));
  }
  std::string PivotPage() const { return folder.Read("out/tool-tip/report.html"); }

  TemporaryFolder folder;
};

TEST_F(CliAuditPivot, NothingPassesOnATipThatItsOwnTestRefutes) {
  const Json audit = AuditAfter({});
  EXPECT_EQ(audit["verdict"], "INCONCLUSIVE");
  const std::string doubts = audit["doubts"].dump();
  EXPECT_EQ(audit["doubts"].size(), 2u) << doubts;
  EXPECT_THAT(doubts, HasSubstr("of the pivoting of tool tip more is left over than its stated"));
  EXPECT_THAT(doubts,
              HasSubstr("a reading that the others contradict was used all the same: "
                        "pose 17 ("));
  EXPECT_THAT(PivotPage(), HasSubstr("<strong>determined, but doubtful</strong>"));
  EXPECT_THAT(PivotPage(), HasSubstr("times what the stated noise explains. A reading"));
}

// Its noise was stated: of type B, as the calibration's.
TEST_F(CliAuditPivot, PassesOnTheSameTipWithoutTheReadingThatSlipped) {
  const Json audit = AuditAfter({"--outliers=reject"});
  EXPECT_EQ(audit["verdict"], "PASS");
  EXPECT_TRUE(audit["doubts"].empty()) << audit["doubts"];
  const Json& budget = audit["points"][0]["budget"];
  EXPECT_EQ(budget.back()["source"], "the point in frame T");
  EXPECT_EQ(budget.back()["type"], "B");
  EXPECT_EQ(budget.front()["type"], "B");
  EXPECT_TRUE(budget.back()["degrees_of_freedom"].is_null());
  EXPECT_THAT(PivotPage(), HasSubstr("<strong>determined</strong>"));
  EXPECT_THAT(PivotPage(), Not(HasSubstr("doubtful")));
}

}  // namespace
}  // namespace hexcal
