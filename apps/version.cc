// SPDX-License-Identifier: BSD-3-Clause
#include "apps/version.h"

#include <ceres/version.h>
#include <fmt/format.h>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "config/database.h"

namespace hexcal {

std::string VersionText() {
  const int fmt_major = FMT_VERSION / 10000, fmt_minor = FMT_VERSION / 100 % 100;
  std::string text = fmt::format("hexcal {}\n", HEXCAL_VERSION);
  text += fmt::format("revision {}\n", RevisionText());
  text += fmt::format("Ceres Solver {}\n", CERES_VERSION_STRING);
  text += fmt::format(
      "Eigen {}.{}.{}\n", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION);
  text += fmt::format("fmt {}.{}.{}\n", fmt_major, fmt_minor, FMT_VERSION % 100);
  text += fmt::format("gflags {}\n", GFLAGS_VERSION);
  text += fmt::format("glog {}\n", GLOG_VERSION);
  text += fmt::format("nlohmann json {}.{}.{}\n",
                      NLOHMANN_JSON_VERSION_MAJOR,
                      NLOHMANN_JSON_VERSION_MINOR,
                      NLOHMANN_JSON_VERSION_PATCH);
  text += fmt::format("SQLite {}\n", DatabaseLibraryVersion());
  text += fmt::format("yaml-cpp {}\n", YAML_CPP_VERSION);
  return text;
}

}  // namespace hexcal
