// SPDX-License-Identifier: BSD-3-Clause
#include "apps/output_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "config/input_error.h"
#include "testing/input_error_text.h"
#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

using ::hexcal::testing::InputErrorText;
using ::hexcal::testing::TemporaryFolder;
using ::testing::HasSubstr;

const std::vector<OutputFile> kResultAndTable = {{"result.json", std::string(kResultMark)},
                                                 {"table.csv", ""}};

std::string OutputErrorText(const TemporaryFolder& top,
                            bool force,
                            const std::vector<std::string>& inputs = {}) {
  try {
    OutputFolder folder(top.Path("out"), "name", kResultAndTable, inputs, force);
  } catch (const OutputError& error) {
    return error.what();
  }
  return "";
}

// Makes out/name/ and one file in it.
void Place(const TemporaryFolder& top, const std::string& file, const std::string& content) {
  std::filesystem::create_directories(top.Path("out/name"));
  top.Write("out/name/" + file, content);
}

TEST(OutputFolder, IsMadeWithItsFirstFile) {
  const TemporaryFolder top;
  OutputFolder folder(top.Path("a/b"), "name", kResultAndTable, {}, false);
  EXPECT_TRUE(top.Names().empty());
  folder.Write({{"table.csv", "1\n"}});
  EXPECT_EQ(top.Read("a/b/name/table.csv"), "1\n");
}

TEST(OutputFolder, ReplacesWhatHexcalWrote) {
  const TemporaryFolder top;
  Place(top, "result.json", "{\n  \"format\": \"hexcal/result/1\",\n");
  Place(top, "table.csv", "a,b\n");
  EXPECT_EQ(OutputErrorText(top, false), "");
}

TEST(OutputFolder, RefusesAForeignFileUnlessForced) {
  const TemporaryFolder top;
  Place(top, "result.json", "{\"format\": \"somebody else's\"}\n");
  EXPECT_NE(OutputErrorText(top, false).find("result.json: this file is in the way"),
            std::string::npos);
  EXPECT_EQ(OutputErrorText(top, true), "");
}

TEST(OutputFolder, RefusesAMarkThatStandsDeepInAForeignFile) {
  const TemporaryFolder top;
  Place(top, "result.json", std::string(1000, ' ') + std::string(kResultMark));
  EXPECT_NE(OutputErrorText(top, false), "");
}

TEST(OutputFolder, ATableIsOursOnlyBesideAFirstFileThatIsOurs) {
  const TemporaryFolder top;
  Place(top, "table.csv", "a,b\n");
  EXPECT_NE(OutputErrorText(top, false).find("table.csv: this file is in the way"),
            std::string::npos);
}

TEST(OutputFolder, LeavesOtherFilesAlone) {
  const TemporaryFolder top;
  Place(top, "notes.txt", "mine");
  EXPECT_EQ(OutputErrorText(top, false), "");
}

TEST(OutputFolder, NeverReplacesAnInputNorAFolder) {
  const TemporaryFolder top;
  Place(top, "result.json", "{\"format\": \"hexcal/result/1\"}");
  const std::string same_file = top.Path("out/../out/name/result.json");
  EXPECT_NE(OutputErrorText(top, true, {same_file}).find("an input of this run"),
            std::string::npos);
  std::filesystem::create_directories(top.Path("out/name/table.csv"));
  EXPECT_NE(OutputErrorText(top, true).find("a folder is in the way"), std::string::npos);
}

TEST(OutputFolder, RefusesAFileWhereAFolderShouldBe) {
  const TemporaryFolder top;
  top.Write("out", "a file");
  EXPECT_NE(OutputErrorText(top, true).find("is a file"), std::string::npos);
}

TEST(OutputFolder, ADanglingLinkIsInTheWay) {
  const TemporaryFolder top;
  std::filesystem::create_directories(top.Path("out/name"));
  std::filesystem::create_symlink(top.Path("nowhere"), top.Path("out/name/result.json"));
  EXPECT_NE(OutputErrorText(top, false).find("in the way"), std::string::npos);
}

std::string Page(const std::string& command) {
  return "<!doctype html>\n<!-- hexcal/report/" + command + "/1 -->\n";
}

OutputFile PageOf(const std::string& command) {
  return {"report.html", "<!-- hexcal/report/", command};
}

TEST(OutputFolder, KeepsThePageOfAnotherCommand) {
  const TemporaryFolder top;
  Place(top, "report.html", Page("calibrate"));
  const auto write = [&](const std::string& command) {
    OutputFolder folder(top.Path("out"), "name", {PageOf(command)}, {}, false);
    ::testing::internal::CaptureStderr();
    folder.Write({{"report.html", Page(command)}});
    return ::testing::internal::GetCapturedStderr();
  };
  const std::string kept = top.Path("out/name/report-calibrate.html");
  EXPECT_THAT(write("audit"), HasSubstr("of 'hexcal calibrate', whose page is now " + kept + "\n"));
  EXPECT_EQ(top.Read("out/name/report-calibrate.html"), Page("calibrate"));
  EXPECT_EQ(top.Read("out/name/report.html"), Page("audit"));
  EXPECT_EQ(write("audit"), "");
  EXPECT_FALSE(std::filesystem::exists(top.Path("out/name/report-audit.html")));
}

TEST(OutputFolder, KeepsAPageNotInThePlaceOfAForeignFile) {
  const TemporaryFolder top;
  Place(top, "report.html", Page("calibrate"));
  Place(top, "report-calibrate.html", "<html>mine</html>");
  const auto open = [&](bool force) {
    OutputFolder(top.Path("out"), "name", {PageOf("audit")}, {}, force);
  };
  EXPECT_THROW(open(false), OutputError);
  EXPECT_NO_THROW(open(true));
  Place(top, "report-calibrate.html", Page("calibrate"));
  EXPECT_NO_THROW(open(false));
}

// Nor is a name taken from a page that leaves the folder.
TEST(OutputFolder, APageThatNamesNoCommandIsReplaced) {
  const TemporaryFolder top;
  Place(top, "report.html", Page("../../x"));
  OutputFolder folder(top.Path("out"), "name", {PageOf("audit")}, {}, false);
  folder.Write({{"report.html", Page("audit")}});
  EXPECT_EQ(top.Names(), std::vector<std::string>{"out"});
}

TEST(OutputFolder, TwoDatasetsOfOneNameAreRefused) {
  RequireDistinctNames({{"a.yaml", "a"}, {"b.yaml", "b"}});
  EXPECT_EQ(InputErrorText([] {
              RequireDistinctNames({{"a.yaml", "x"}, {"b.yaml", "y"}, {"c.yaml", "x"}});
            }),
            "c.yaml: found the name 'x', which a.yaml has too, expected a name of its own: it "
            "becomes the folder of the results");
}

}  // namespace
}  // namespace hexcal
