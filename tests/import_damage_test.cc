// SPDX-License-Identifier: BSD-3-Clause
// Files that are cut, damaged or hostile, for the formats of text; what each format means by its
// bytes is tested with its reader. Memory errors show under the sanitizers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "measurement/importers/formats.h"
#include "measurement/importers/hexapod_file.h"
#include "testing/import_files.h"

namespace hexcal {
namespace {

using ::testing::HasSubstr;
using testing::ImportError;
using testing::ImportPath;
using testing::ImportText;
using testing::InputErrorText;
using ::testing::Not;
using testing::RefusedOfDamaged;
using testing::RefusedOfDamagedFiles;
using testing::TemporaryFolder;

ImportOptions LabMap() {
  ImportOptions options;
  options.map = ImportPath("lab.yaml");
  return options;
}

struct Sample {
  std::string_view format;
  const char* file;
  int refused;  // at least so many of its damaged variants
};

// Every second byte; the numbers are what a reader that looks at its input must refuse: they were
// counted, and stand a tenth below.
const Sample kRecordings[] = {{"first_principles", "first_principles.tsv", 580},
                              {"motive", "motive.csv", 2100},
                              {"tum", "trajectory.tum", 275},
                              {"euroc", "trajectory.euroc.csv", 430},
                              {"columns", "lab.csv", 490}};

TEST(Damage, LeavesRecordingsReadOrRefused) {
  for (const Sample& sample : kRecordings) {
    const ImportOptions options = sample.format == "columns" ? LabMap() : ImportOptions{};
    EXPECT_GT(RefusedOfDamagedFiles(sample.format, ImportText(sample.file), 2, options),
              sample.refused)
        << sample.format;
  }
}

TEST(Damage, LeavesMapsReadOrRefused) {
  const TemporaryFolder folder;
  ImportOptions options;
  const auto take = [&](const std::string& map) {
    options.map = folder.Write("map.yaml", map);
    return InputErrorText(
        [&] { ReadRecording(*FindImportFormat("columns"), ImportPath("lab.csv"), options); });
  };
  EXPECT_GT(RefusedOfDamaged(take, ImportText("lab.yaml"), 2), 920);
}

TEST(Damage, LeavesBodiesReadOrRefused) {
  const TemporaryFolder folder;
  const auto take = [&](const std::string& text) {
    const std::string path = folder.Write("in", text);
    return InputErrorText([&] { FindImportFormat("rig")->read_shape(path); });
  };
  EXPECT_GT(RefusedOfDamaged(take, ImportText("body.rig"), 2), 850);
}

TEST(Damage, LeavesTransformsReadOrRefused) {
  const TemporaryFolder folder;
  const auto take = [&](const std::string& text) {
    const std::string path = folder.Write("in", text);
    return InputErrorText([&] { FindImportFormat("easy_handeye")->read_transform(path); });
  };
  EXPECT_GT(RefusedOfDamaged(take, ImportText("easy_handeye.yaml"), 2), 800);
}

// What a file may hold to make a reader wait, fill the memory or lose its way.
std::vector<std::string> HostileTexts() {
  std::string nested, wide = "a";
  for (int i = 0; i < 20000; ++i) nested += "[";
  for (int i = 0; i < 20000; ++i) wide += ",a";
  return {"",
          std::string(1, '\0'),
          "\xef\xbb\xbf",
          std::string("\xff\xfe"
                      "F\0r\0a\0",
                      8),
          std::string(2000000, 'x'),
          std::string(2000000, ','),
          std::string(200000, '\n'),
          wide + "\n" + wide + "\n",
          nested,
          "&a [*a, *a]\n",
          "Number of frames: 99999999999999999999\nFrequency: 1e999\nUnits: mm\n\nFrame\tA x\n",
          "\x1b[2J\x1b]0;title\x07\n</script><script>alert(1)</script>\n=1+1\n",
          "../../etc/passwd\n"};
}

TEST(Hostile, TextsAreRefusedByEveryReader) {
  for (const std::string& text : HostileTexts()) {
    for (const ImportFormat& format : ImportFormats()) {
      const TemporaryFolder folder;
      const std::string path = folder.Write("in", text);
      const std::string message = InputErrorText([&] {
        if (format.read_recording != nullptr) ReadRecording(format, path, LabMap());
        if (format.read_shape != nullptr) format.read_shape(path);
        if (format.read_transform != nullptr) format.read_transform(path);
      });
      const std::string what = std::string(format.name) + ": " + text.substr(0, 40);
      EXPECT_THAT(message, HasSubstr("expected")) << what;
      EXPECT_LT(message.size(), 1000u) << what;
      EXPECT_THAT(message, Not(HasSubstr("\x1b"))) << what;  // a terminal would obey it
    }
  }
}

}  // namespace
}  // namespace hexcal
