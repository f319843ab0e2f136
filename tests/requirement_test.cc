// SPDX-License-Identifier: BSD-3-Clause
#include "report/requirement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "config/input_error.h"
#include "config/units.h"
#include "testing/input_error_text.h"
#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string kGood = R"(format: hexcal/requirement/1
units: {length: mm, angle: deg}
identification: {operator: "<b>"}
points:
  - {name: tip, xyz: [1, 2, 120], standard_deviation: 0.05}
  - {name: flange, xyz: [0, 0, 0]}
workspace: {x: [-10, 10], y: [-20, 20], z: [200, 240], rx: [-5, 5], ry: [0, 0], rz: [-90, 90]}
robot: {position: 0.005, orientation: 0.1, from: data sheet, degrees_of_freedom: 30}
sources:
  - {name: patient, at: world, position: 0.2, orientation: 0.05, distribution: uniform, from: assumed}
requirements:
  - {name: drilling, point: tip, limit: 0.5}
  - {name: rest, point: flange, over: poses, limit: 1, probability: 0.99}
)";

class RequirementFile : public ::testing::Test {
 protected:
  Requirements Read(const std::string& text) {
    return ReadRequirements(folder.Write("r.yaml", text));
  }
  // The message for the good file with one part in place of another.
  std::string Refusal(const std::string& part, const std::string& other) {
    std::string text = kGood;
    const std::size_t at = text.find(part);
    EXPECT_NE(at, std::string::npos) << part;
    text.replace(at, part.size(), other);
    return testing::InputErrorText([&] { Read(text); });
  }

  testing::TemporaryFolder folder;
};

TEST_F(RequirementFile, IsReadInSi) {
  const Requirements r = Read(kGood);
  EXPECT_EQ(r.identification[0].second, "<b>");
  ASSERT_EQ(r.points.size(), 2u);
  EXPECT_NEAR(r.points[0].p_in_tool.z(), 0.12, 1e-15);
  EXPECT_NEAR(r.points[0].standard_deviation, 5e-5, 1e-18);
  EXPECT_NEAR((*r.workspace)[2][1], 0.24, 1e-15);
  EXPECT_NEAR((*r.workspace)[5][0], -0.5 * kPi, 1e-12);
  EXPECT_NEAR(r.robot->source.position, 5e-6, 1e-18);
  EXPECT_NEAR(r.robot->source.orientation, 0.1 * kPi / 180.0, 1e-12);
  EXPECT_EQ(r.robot->source.site, SourceSite::kPlatform);
  EXPECT_EQ(r.robot->source.degrees_of_freedom, 30.0);
  EXPECT_EQ(r.robot->origin, "data sheet");
  ASSERT_EQ(r.sources.size(), 1u);
  EXPECT_EQ(r.sources[0].source.site, SourceSite::kWorld);
  EXPECT_EQ(r.sources[0].source.spread, Spread1d::kUniform);
  EXPECT_TRUE(std::isinf(r.sources[0].source.degrees_of_freedom));
  ASSERT_EQ(r.requirements.size(), 2u);
  EXPECT_EQ(r.requirements[0].over, Requirement::Places::kWorkspace);
  EXPECT_NEAR(r.requirements[0].limit, 5e-4, 1e-18);
  EXPECT_EQ(r.requirements[0].probability, 0.95);
  EXPECT_EQ(r.requirements[1].point, 1u);
  EXPECT_EQ(r.requirements[1].over, Requirement::Places::kPoses);
}

TEST_F(RequirementFile, IsRefusedWithThePlaceAndWhatWasExpected) {
  EXPECT_THAT(Refusal("requirement/1", "requirement/2"), HasSubstr("r.yaml:1:9"));
  EXPECT_THAT(Refusal("length: mm", "length: inch"), HasSubstr("m or mm"));
  EXPECT_THAT(Refusal("point: tip", "point: tpi"),
              AllOf(HasSubstr("r.yaml:12:"), HasSubstr("'tpi'")));
  EXPECT_THAT(Refusal("name: flange, xyz", "name: tip, xyz"), HasSubstr("a second point 'tip'"));
  EXPECT_THAT(Refusal("name: rest", "name: drilling"),
              AllOf(HasSubstr("r.yaml:13:"), HasSubstr("a second requirement 'drilling'")));
  EXPECT_THAT(Refusal("xyz: [0, 0, 0]", "xyz: [0, 0]"), HasSubstr("r.yaml:6:"));
  EXPECT_THAT(Refusal("x: [-10, 10]", "x: [10, -10]"), HasSubstr("[low, high]"));
  EXPECT_THAT(Refusal("rx: [-5, 5], ", ""), HasSubstr("rx"));
  EXPECT_THAT(Refusal("from: data sheet, ", ""), HasSubstr("from"));
  EXPECT_THAT(Refusal("robot: {position: 0.005, ", "robot: {"), HasSubstr("position"));
  EXPECT_THAT(Refusal("position: 0.2", "position: -0.2"), HasSubstr("r.yaml:10:"));
  EXPECT_THAT(Refusal("at: world", "at: point"), HasSubstr("position alone"));
  EXPECT_THAT(Refusal("at: world", "at: wrist"), HasSubstr("platform or tool or world or point"));
  EXPECT_THAT(Refusal("distribution: uniform", "distribution: u"), HasSubstr("normal or uniform"));
  EXPECT_THAT(Refusal("limit: 0.5", "limit: 0"), HasSubstr("r.yaml:12:"));
  EXPECT_THAT(Refusal("limit: 0.5", "limit: .nan"), HasSubstr("r.yaml:12:"));
  EXPECT_THAT(Refusal("probability: 0.99", "probability: 99"), HasSubstr("0.9999"));
  EXPECT_THAT(Refusal("limit: 0.5", "limits: 0.5"), HasSubstr("limit"));
  EXPECT_THAT(Refusal("degrees_of_freedom: 30", "degrees_of_freedom: 0"), HasSubstr("1"));
}

// What hexcal pivot writes, but for what the audit does not read.
const std::string kPivot = R"({"format": "hexcal/pivot/1", "trustworthy": true,
"tool": {"markers": ["a", "b", "c"], "xyz": [[0, 0, 0], [0.1, 0, 0], [0, 0.1, 0]]},
"tip": {"xyz": [0.001, 0.002, 0.12], "covariance": [[4e-10, 0, 0], [0, 4e-10, 1e-10], [0, 1e-10, 9e-10]],
"degrees_of_freedom_together": 50}}
)";

class PivotPointFile : public RequirementFile {
 protected:
  Requirements ReadWith(const std::string& pivot, const std::string& point = "pivot: pivot.json") {
    folder.Write("pivot.json", pivot);
    std::string text = kGood;
    const std::string was = "xyz: [1, 2, 120], standard_deviation: 0.05";
    text.replace(text.find(was), was.size(), point);
    return Read(text);
  }
  std::string PivotRefusal(const std::string& part, const std::string& other) {
    std::string pivot = kPivot;
    const std::size_t at = pivot.find(part);
    EXPECT_NE(at, std::string::npos) << part;
    pivot.replace(at, part.size(), other);
    return testing::InputErrorText([&] { ReadWith(pivot); });
  }
  Dataset DatasetWith(const Eigen::Matrix3d& markers) const {
    Dataset dataset;
    dataset.measurement = Measurement{};
    dataset.measurement->kind = Measurement::Kind::kMarkers;
    dataset.measurement->bodies[1].p_in_body = markers;
    return dataset;
  }
};

TEST_F(PivotPointFile, BringsThePointItsCovarianceAndDegreesOfFreedom) {
  const NamedPoint point = ReadWith(kPivot).points.at(0);
  EXPECT_EQ(point.p_in_tool, Eigen::Vector3d(0.001, 0.002, 0.12));
  const ErrorSource source = point.Source();
  EXPECT_EQ(source.site, SourceSite::kPointInTool);
  EXPECT_EQ((*source.covariance_in_tool)(1, 2), 1e-10);
  EXPECT_EQ((*source.covariance_in_tool)(2, 2), 9e-10);
  EXPECT_EQ(source.degrees_of_freedom, 50.0);
  EXPECT_EQ(source.position, 0.0);
  EXPECT_EQ(ReadWith(kPivot).points.at(1).Source().site, SourceSite::kPoint);
}

// A file without the test and the readings is read as it was.
TEST_F(PivotPointFile, BringsWhatItsOwnFitLeavesInDoubt) {
  const auto doubts = [&](const std::string& more) {
    std::string pivot = kPivot;
    pivot.replace(pivot.rfind("}\n"), 2, more + "}\n");
    return ReadWith(pivot).points.at(0).pivot->doubts;
  };
  const auto test = [](const std::string& value, const std::string& is_a_test) {
    return R"(, "chi_square": {"value": )" + value +
           R"(, "degrees_of_freedom": 114, "low": 86, "high": 145, "is_a_test": )" + is_a_test +
           "}";
  };
  const auto readings = [](const std::string& used) {
    return R"(, "poses": [{"pose": "1", "line": 3, "used": true}, {"pose": "2", "line": 4, "used": )" +
           used + R"(}], "outliers": [{"pose": "2", "line": 4, "sigmas": 20.5}])";
  };
  EXPECT_TRUE(doubts("").empty());
  EXPECT_TRUE(doubts(test("145", "true") + readings("false")).empty());
  EXPECT_TRUE(doubts(test("495.9", "false")).empty());
  const auto both = doubts(test("495.9", "true") + readings("true"));
  ASSERT_EQ(both.size(), 2u);
  EXPECT_THAT(both[0], HasSubstr("495.9 with 114 degrees of freedom, not above 145"));
  EXPECT_THAT(both[1], HasSubstr("pose 2 (20.5 sigma off)"));
  EXPECT_THAT(testing::InputErrorText([&] { doubts(test("null", "true")); }),
              HasSubstr("pivot.json:4:"));
}

TEST_F(PivotPointFile, RefusesWhatIsNoDeterminedTip) {
  EXPECT_THAT(PivotRefusal("true", "false"),
              AllOf(HasSubstr("pivot.json:1:"), HasSubstr("not determined")));
  EXPECT_THAT(PivotRefusal("hexcal/pivot/1", "hexcal/result/1"), HasSubstr("'hexcal/pivot/1'"));
  EXPECT_THAT(PivotRefusal("[0, 4e-10, 1e-10]", "[0, 4e-10, 2e-10]"), HasSubstr("no covariance"));
  EXPECT_THAT(PivotRefusal("9e-10", "-9e-10"), HasSubstr("pivot.json:3:"));
  EXPECT_THAT(PivotRefusal("9e-10", "null"), HasSubstr("pivot.json:3:"));
  EXPECT_THAT(PivotRefusal("50", "0"), HasSubstr("degrees of freedom"));
  EXPECT_THAT(PivotRefusal("0.12]", "1e9]"), HasSubstr("beyond any tool"));
  EXPECT_THAT(PivotRefusal("\"tool\"", "\"tolo\""), HasSubstr("no key 'tool'"));
  EXPECT_THAT(PivotRefusal("\"xyz\": [0.001", "\"xy\": [0.001"), HasSubstr("no key 'xyz'"));
}

TEST_F(PivotPointFile, MustLieBesideTheRequirementFileAndSayItAll) {
  const auto refusal = [&](const std::string& point) {
    return testing::InputErrorText([&] { ReadWith(kPivot, point); });
  };
  EXPECT_THAT(refusal("pivot: ../pivot.json"),
              AllOf(HasSubstr("r.yaml:5:24"), HasSubstr("leaves")));
  EXPECT_THAT(refusal("pivot: /etc/passwd"), HasSubstr("is absolute"));
  EXPECT_THAT(refusal("pivot: none.json"), HasSubstr("no file 'none.json'"));
  EXPECT_THAT(refusal("pivot: pivot.json, xyz: [1, 2, 3]"), HasSubstr("'xyz' beside 'pivot'"));
}

TEST_F(PivotPointFile, MustBeOfTheSameBody) {
  const PivotPoint point = *ReadWith(kPivot).points.at(0).pivot;
  Eigen::Matrix3d markers;
  markers << 0.1, 0, 0, 0, 0, 0.1, 0, 0, 0;  // in another order
  RequireSameTool(point, DatasetWith(markers));
  markers(0, 0) = 0.101;
  EXPECT_THAT(testing::InputErrorText([&] { RequireSameTool(point, DatasetWith(markers)); }),
              AllOf(HasSubstr("r.yaml:5:24"), HasSubstr("other markers")));
}

}  // namespace
}  // namespace hexcal
