// SPDX-License-Identifier: BSD-3-Clause
#include <fstream>

#include "fuzz/readers.h"
#include "report/earlier_result.h"
#include "report/requirement.h"

namespace hexcal::fuzz {
namespace {

void ReadRequirement(const std::string&, const std::string& path, const Reader&) {
  ReadRequirements(path);
}

void ReadResult(const std::string&, const std::string& path, const Reader&) {
  ReadEarlierResult(path);
}

void ReadTip(const std::string& folder, const std::string&, const Reader& self) {
  const std::string path = folder + "/requirement.yaml";
  std::ofstream(path) << "format: hexcal/requirement/1\npoints:\n  tip: {pivot: " << self.file
                      << "}\n";
  ReadRequirements(path);
}

}  // namespace

std::vector<Reader> ReportReaders() {
  return {{"requirement", "fuzzed.yaml", &ReadRequirement},
          {"earlier_result", "fuzzed.json", &ReadResult},
          {"pivot_point", "fuzzed.json", &ReadTip}};
}

}  // namespace hexcal::fuzz
