// SPDX-License-Identifier: BSD-3-Clause
// hexcal export: every file is read back here by code that shares nothing with what wrote it.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "config/strict_yaml.h"
#include "measurement/importers/formats.h"
#include "measurement/importers/yaml_poses.h"
#include "report/export/formats.h"
#include "report/export/writers.h"
#include "testing/cli_test.h"
#include "testing/matchers.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using ::hexcal::testing::MatrixNear;
using ::hexcal::testing::PoseNear;
using ::hexcal::testing::ProgramResult;
using ::testing::HasSubstr;
using Json = nlohmann::json;

constexpr double kExact = 1e-12;
const std::string kDataset = std::string(HEXCAL_EXAMPLES) + "/paper/dataset.yaml";

class CliExport : public testing::CliTest {
 protected:
  void SetUp() override {
    const ProgramResult calibrated = Call({"calibrate", kDataset, "--out=out"});
    ASSERT_EQ(calibrated.status, 0) << calibrated.err;
    for (const auto& entry : std::filesystem::directory_iterator(folder.Path("out")))
      result_path = entry.path().string() + "/result.json";
    std::ifstream file(result_path);
    result = Json::parse(file);
  }
  ProgramResult Export(const std::string& format, const std::vector<std::string>& more = {}) const {
    return Call({"export", format, result_path, "--out=ex"}, more);
  }
  std::string Exported(const std::string& format,
                       const std::string& file,
                       const std::vector<std::string>& more = {}) const {
    const ProgramResult exported = Export(format, more);
    EXPECT_EQ(exported.status, 0) << exported.err;
    EXPECT_THAT(exported.out, HasSubstr("ex/" + file));
    return folder.Read("ex/" + file);
  }
  Pose3d Mount(const char* name) const {
    const std::vector<double> t = result[name]["xyz"], q = result[name]["quaternion"];
    return {Eigen::Vector3d(t[0], t[1], t[2]), Eigen::Quaterniond(q[0], q[1], q[2], q[3])};
  }

  std::string result_path;
  Json result;
};

std::vector<double> Numbers(const std::string& text) {
  std::vector<double> numbers;
  std::istringstream words(text);
  words.imbue(std::locale::classic());
  for (double value; words >> value;) numbers.push_back(value);
  return numbers;
}

// The texts of the first group in all matches.
std::vector<std::string> Matches(const std::string& text, const char* pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it)
    found.push_back((*it)[1]);
  return found;
}

Pose3d PoseOf(const std::vector<double>& v) {  // x y z qx qy qz qw
  return {Eigen::Vector3d(v[0], v[1], v[2]), Eigen::Quaterniond(v.at(6), v[3], v[4], v[5])};
}

TEST_F(CliExport, Ros1) {
  const std::string text =
      Exported("ros1", "static_transforms.launch", {"--base_frame=hexapod/base"});
  const std::vector<std::string> args = Matches(text, "args=\"([^\"]*)\"");
  ASSERT_EQ(args.size(), 2u);
  EXPECT_TRUE(PoseNear(PoseOf(Numbers(args[0])), Mount("world_from_base"), kExact, kExact));
  EXPECT_TRUE(PoseNear(PoseOf(Numbers(args[1])), Mount("platform_from_tool"), kExact, kExact));
  EXPECT_THAT(args[0], ::testing::EndsWith(" world hexapod/base"));
  EXPECT_THAT(args[1], ::testing::EndsWith(" platform tool"));
}

TEST_F(CliExport, Ros2) {
  const std::string text = Exported("ros2", "static_transforms.launch.xml");
  const std::vector<std::string> args = Matches(text, "args=\"([^\"]*)\"");
  ASSERT_EQ(args.size(), 2u);
  std::vector<double> values;
  for (const char* flag : {"--x ", "--y ", "--z ", "--qx ", "--qy ", "--qz ", "--qw "})
    values.push_back(Numbers(args[1].substr(args[1].find(flag) + std::string(flag).size())).at(0));
  EXPECT_TRUE(PoseNear(PoseOf(values), Mount("platform_from_tool"), kExact, kExact));
  EXPECT_THAT(args[1], HasSubstr("--frame-id platform --child-frame-id tool"));
}

TEST_F(CliExport, UrdfInFixedAxisAngles) {
  const std::string text = Exported("urdf", "mounts.urdf");
  const std::vector<std::string> xyz = Matches(text, "xyz=\"([^\"]*)\"");
  const std::vector<std::string> rpy = Matches(text, "rpy=\"([^\"]*)\"");
  ASSERT_EQ(rpy.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const std::vector<double> t = Numbers(xyz[i]), a = Numbers(rpy[i]);
    const Eigen::Quaterniond rotation = Eigen::AngleAxisd(a[2], Eigen::Vector3d::UnitZ()) *
                                        Eigen::AngleAxisd(a[1], Eigen::Vector3d::UnitY()) *
                                        Eigen::AngleAxisd(a[0], Eigen::Vector3d::UnitX());
    EXPECT_TRUE(PoseNear({Eigen::Vector3d(t[0], t[1], t[2]), rotation},
                         Mount(i == 0 ? "world_from_base" : "platform_from_tool"),
                         kExact,
                         1e-9));
  }
}

TEST_F(CliExport, EasyHandeye) {
  Exported("easy_handeye", "base_easy_handeye.yaml");
  const StoredTransform base = ReadEasyHandeye(folder.Path("ex/base_easy_handeye.yaml"));
  const StoredTransform tool = ReadEasyHandeye(folder.Path("ex/tool_easy_handeye.yaml"));
  EXPECT_FALSE(base.is_tool);
  EXPECT_TRUE(tool.is_tool);
  EXPECT_EQ(base.parent, "base");
  EXPECT_EQ(base.child, "world");
  EXPECT_EQ(tool.parent, "platform");
  EXPECT_EQ(tool.child, "tool");
  EXPECT_TRUE(PoseNear(base.parent_from_child, Mount("world_from_base").Inverse(), kExact, kExact));
  EXPECT_TRUE(PoseNear(tool.parent_from_child, Mount("platform_from_tool"), kExact, kExact));
}

// Small motions drawn by hexcal's covariance scatter by the exported one: of x y z, and of the
// turns by which the parent's axes see the rotation move.
Matrix6d ScatterInParent(const Pose3d& pose, const Matrix6d& covariance, bool inverse) {
  std::mt19937_64 random = testing::SeededByTest();
  const Matrix6d root = covariance.llt().matrixL();
  const Pose3d mean = inverse ? pose.Inverse() : pose;
  constexpr int kDraws = 40000;
  Matrix6d sum = Matrix6d::Zero();
  for (int i = 0; i < kDraws; ++i) {
    const Pose3d drawn = Plus(pose, Vector6d(root * testing::Normal(random, 6)));
    const Pose3d moved = inverse ? drawn.Inverse() : drawn;
    Vector6d d;
    d << moved.translation - mean.translation,
        Log(Eigen::Quaterniond(moved.rotation * mean.rotation.conjugate()));
    sum += d * d.transpose();
  }
  return sum / kDraws;
}

void ExpectScatter(const Matrix6d& exported, const Matrix6d& drawn) {
  const Vector6d scale = exported.diagonal().cwiseSqrt().cwiseInverse();
  const Matrix6d difference = scale.asDiagonal() * (exported - drawn) * scale.asDiagonal();
  EXPECT_LT(difference.cwiseAbs().maxCoeff(), 0.04);  // of 40000 draws: 5.6 standard deviations
}

Matrix6d CovarianceOf(const Json& result, std::size_t first) {
  Matrix6d covariance;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j)
      covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          result["covariance"][first + i][first + j].get<double>();
  return covariance;
}

TEST_F(CliExport, PoseWithCovarianceInTheParentsAxes) {
  Exported("pose_with_covariance", "tool_pose_with_covariance.yaml");
  for (const bool is_tool : {false, true}) {
    const YamlNode root = ParseYamlFile(folder.Path(is_tool ? "ex/tool_pose_with_covariance.yaml"
                                                            : "ex/base_pose_with_covariance.yaml"));
    const MapReader message(root, "message", {"header", "pose"});
    const MapReader outer(message.Required("pose"), "pose", {"pose", "covariance"});
    const MapReader pose(outer.Required("pose"), "pose", {"position", "orientation"});
    const MapReader p(pose.Required("position"), "position", {"x", "y", "z"});
    const MapReader q(pose.Required("orientation"), "orientation", {"x", "y", "z", "w"});
    std::vector<double> values;
    for (const char* key : {"x", "y", "z"}) values.push_back(ReadNumber(p.Required(key)));
    for (const char* key : {"x", "y", "z", "w"}) values.push_back(ReadNumber(q.Required(key)));
    const Pose3d mount = Mount(is_tool ? "platform_from_tool" : "world_from_base");
    EXPECT_TRUE(PoseNear(PoseOf(values), mount, kExact, kExact));
    const std::vector<double> listed = ReadNumbers(outer.Required("covariance"), 36, "36 numbers");
    const Matrix6d exported =
        Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(listed.data());
    EXPECT_TRUE(MatrixNear(exported, exported.transpose(), 1e-18));
    ExpectScatter(exported, ScatterInParent(mount, CovarianceOf(result, is_tool ? 6 : 0), false));
  }
}

TEST_F(CliExport, EasyHandeyeHasTheCovarianceOfTheInverseBase) {
  Exported("easy_handeye", "base_easy_handeye.yaml");
  const YamlNode root = ParseYamlFile(folder.Path("ex/base_easy_handeye.yaml"));
  const MapReader map(root, "calibration", {"parameters", "transformation", "covariance"});
  Matrix6d exported;
  int i = 0;
  for (const YamlNode& row : ReadSequence(map.Required("covariance")))
    exported.row(i++) = Eigen::Map<const Vector6d>(ReadNumbers(row, 6, "6 numbers").data());
  ExpectScatter(exported, ScatterInParent(Mount("world_from_base"), CovarianceOf(result, 0), true));
}

TEST_F(CliExport, TumPairsDifferByTheResiduals) {
  Exported("tum", "measured.tum", {"--dataset=" + kDataset});
  const ImportFormat& tum = *FindImportFormat("tum");
  const Recording measured = ReadRecording(tum, folder.Path("ex/measured.tum"), {});
  const Recording predicted = ReadRecording(tum, folder.Path("ex/predicted.tum"), {});
  const std::size_t rows = result["poses"].size();
  ASSERT_EQ(measured.rows, rows);
  ASSERT_EQ(predicted.rows, rows);
  EXPECT_EQ(measured.times, predicted.times);
  for (std::size_t i = 0; i < rows; ++i) {
    const std::vector<double> residual = result["poses"][i]["residual"];
    const Vector6d d = Minus(*measured.bodies[0].poses[i], *predicted.bodies[0].poses[i]);
    EXPECT_TRUE(MatrixNear(d, Eigen::Map<const Vector6d>(residual.data()), 1e-12));
  }
}

TEST_F(CliExport, ResidualsAsATable) {
  std::istringstream lines(Exported("residuals", "residuals.csv"));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line[0], '#');
  std::getline(lines, line);
  EXPECT_EQ(line, "pose,weight,dx,dy,dz,rx,ry,rz");
  for (const Json& pose : result["poses"]) {
    ASSERT_TRUE(std::getline(lines, line));
    const std::size_t comma = line.find(',');
    EXPECT_EQ(line.substr(0, comma), pose["pose"]);
    std::replace(line.begin(), line.end(), ',', ' ');
    std::vector<double> expected = {pose["weight"]};
    for (const Json& value : pose["residual"]) expected.push_back(value);
    EXPECT_EQ(Numbers(line.substr(comma)), expected);
  }
  EXPECT_FALSE(std::getline(lines, line));
}

// Another measurement of the same poses, and one digit of one of them.
TEST_F(CliExport, RefusesAnotherDatasetThanTheResults) {
  const std::string examples = std::string(HEXCAL_EXAMPLES) + "/paper/";
  for (const auto& entry : std::filesystem::directory_iterator(examples)) {
    const std::string name = entry.path().filename().string();
    std::ifstream file(entry.path());
    folder.Write(name, std::string(std::istreambuf_iterator<char>(file), {}));
  }
  const std::vector<std::string> dataset = {"--dataset=" + folder.Path("dataset.yaml")};
  EXPECT_EQ(Export("tum", dataset).status, 0);
  Json other = result;
  std::string readings = other["poses"][3]["readings"];
  readings[0] = readings[0] == '0' ? '1' : '0';
  other["poses"][3]["readings"] = readings;
  result_path = folder.Write("other.json", other.dump());
  const ProgramResult refused = Export("tum", dataset);
  EXPECT_EQ(refused.status, 3);
  const std::string label = other["poses"][3]["pose"];
  EXPECT_THAT(refused.err,
              HasSubstr("other.json: found other readings of the pose '" + label + "' than in " +
                        folder.Path("dataset.yaml") + ", expected the result of this dataset"));
  for (Json& pose : other["poses"]) pose.erase("readings");  // as results of earlier versions
  result_path = folder.Write("old.json", other.dump());
  EXPECT_EQ(Export("tum", dataset).status, 0);
}

TEST_F(CliExport, RefusesWhatItCannotUse) {
  EXPECT_EQ(Export("ros3").status, 2);
  EXPECT_THAT(Export("ros3").err, HasSubstr("did you mean 'ros"));
  EXPECT_THAT(Export("tum").err, HasSubstr("--dataset=FILE is missing"));
  EXPECT_EQ(Export("ros1", {"--tool_frame=\"/><evil x=\""}).status, 2);
  EXPECT_EQ(Export("ros1", {"--tool_frame=-x"}).status, 2);
  const ProgramResult nameless = Export("ros1", {"--world_frame="});
  EXPECT_EQ(nameless.status, 2);
  EXPECT_THAT(nameless.err, HasSubstr("export: --world_frame: found '', expected a name\n"));
  const ProgramResult twice = Export("ros1", {"--base_frame=world"});
  EXPECT_EQ(twice.status, 2);
  EXPECT_THAT(twice.err, HasSubstr("--world_frame and --base_frame: found 'world' twice"));
  EXPECT_EQ(Call({"export", "ros1", kDataset, "--out=ex"}).status, 3);
  const std::string path = result_path;
  Json broken = result;
  broken["format"] = "hexcal/result/9";
  result_path = folder.Write("r.json", broken.dump());
  EXPECT_THAT(Export("ros1").err, HasSubstr("'hexcal/result/1'"));
  broken = result;
  broken["world_from_base"]["quaternion"] = {2, 0, 0, 0};
  result_path = folder.Write("r.json", broken.dump());
  EXPECT_EQ(Export("ros1").status, 3);
  broken = result;
  broken["covariance"][0][0] = nullptr;
  result_path = folder.Write("r.json", broken.dump());
  EXPECT_THAT(Export("pose_with_covariance").err, HasSubstr("no whole covariance of the base"));
  EXPECT_EQ(Export("easy_handeye").status, 0);
  folder.Write("ex/base_easy_handeye.yaml", "mine");
  EXPECT_EQ(Export("easy_handeye").status, 5);
  result_path = folder.Write("r.json", result.dump().substr(0, 1000));
  EXPECT_EQ(Export("ros1").status, 3);
}

// Each transform is there twice: who mended one by hand does not get the other.
TEST_F(CliExport, RefusesATransformThatContradictsItsMatrix) {
  for (const char* mount : {"world_from_base", "platform_from_tool"}) {
    Json broken = result;
    broken[mount]["xyz"][1] = 0.5;
    const double stated = result[mount]["matrix"][1][3];
    result_path = folder.Write("r.json", broken.dump(1));
    const ProgramResult moved = Export("ros1");
    EXPECT_EQ(moved.status, 3);
    EXPECT_THAT(moved.err, HasSubstr(fmt::format("found {} in row 2 and column 4", stated)));
    EXPECT_THAT(moved.err, HasSubstr("expected 0.5, as xyz and quaternion say"));
    EXPECT_THAT(moved.err, ::testing::ContainsRegex("r.json:[0-9]+:"));
    broken = result;
    broken[mount]["quaternion"] = {1, 0, 0, 0};
    result_path = folder.Write("r.json", broken.dump(1));
    EXPECT_THAT(Export("ros1").err, HasSubstr("in row 1 and column 1 of the matrix, expected 1,"));
    broken = result;
    broken[mount]["matrix"].erase(3);
    result_path = folder.Write("r.json", broken.dump(1));
    EXPECT_THAT(Export("ros1").err, HasSubstr("expected 4 rows of 4 numbers"));
    broken[mount].erase("matrix");
    result_path = folder.Write("r.json", broken.dump(1));
    EXPECT_EQ(Export("ros1").status, 0);
  }
}

TEST_F(CliExport, HelpAndDocsNameEveryFormat) {
  const std::string help = Call({"help", "export"}).out;
  std::ostringstream docs;
  docs << std::ifstream(std::string(HEXCAL_SOURCE) + "/docs/formats.md").rdbuf();
  for (const ExportFormat& format : ExportFormats()) {
    EXPECT_THAT(help, HasSubstr(fmt::format("  {}: ", format.name)));
    EXPECT_THAT(docs.str(), HasSubstr(fmt::format("| `{}` | {} |", format.name, format.summary)));
    for (const std::string_view file : format.files)
      EXPECT_THAT(docs.str(), HasSubstr(fmt::format("`{}`", file)));
  }
}

}  // namespace
}  // namespace hexcal
