// SPDX-License-Identifier: BSD-3-Clause
// Writes datasets with an effect hidden in them, each in a folder of its own with its truth beside
// it, for trying `hexcal discover` by hand.
//   hidden_cases --out=DIR --count=20 --kind=any --snr=12

#include <fmt/format.h>
#include <gflags/gflags.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>

#include "hidden/write_case.h"

DEFINE_string(out, "", "folder for the cases");
DEFINE_int32(count, 10, "how many");
DEFINE_uint64(seed, 1, "of the series");
DEFINE_string(kind, "any", "clean, any, pair, unlisted, a name, or two joined by +");
DEFINE_double(snr, 12.0, "clearness of each effect after base and tool");
DEFINE_string(regime, "white", "of the noise");
DEFINE_double(sigma, 0.0, "of a marker across the line of sight, m; 0: 3 to 150 um");
DEFINE_string(size, "any", "of the machine: small, large or any");
DEFINE_bool(detailed, false, "physics beyond the names' own forms: harmonic, lag, unequal legs");

namespace hexcal::hidden {
namespace {

CaseOptions OptionsOfFlags() {
  CaseOptions options;
  options.kind = FLAGS_kind;
  options.snr = FLAGS_snr;
  const auto regime = FindRegime(FLAGS_regime);
  if (!regime) throw std::runtime_error("--regime: no noise is called " + FLAGS_regime);
  options.regime = *regime;
  options.scene.sigma = FLAGS_sigma;
  if (FLAGS_size == "small") options.scene.size = Size::kSmall;
  if (FLAGS_size == "large") options.scene.size = Size::kLarge;
  if (FLAGS_detailed) options.detail = Detailed();
  return options;
}

void Write(const std::filesystem::path& folder, const Case& made, const CaseOptions& options) {
  std::filesystem::create_directories(folder / "heldout");
  for (const auto& [name, content] : CaseFiles(made, options)) {
    std::ofstream file(folder / name, std::ios::binary);
    file << content;
    if (!file.flush()) throw std::runtime_error("cannot write " + (folder / name).string());
  }
}

void Run() {
  if (FLAGS_out.empty()) throw std::runtime_error("--out is missing");
  const CaseOptions options = OptionsOfFlags();
  for (int number = 0; number < FLAGS_count; ++number) {
    const Case made = MakeCase(options, FLAGS_seed, number);
    Write(std::filesystem::path(FLAGS_out) / made.name, made, options);
    std::string names;
    for (const HiddenEffect& effect : made.effects) names += " " + effect.name;
    fmt::print("{}:{}\n", made.name, names.empty() ? " none" : names);
  }
}

}  // namespace
}  // namespace hexcal::hidden

int main(int argc, char** argv) {
  gflags::ParseCommandLineFlags(&argc, &argv, true);
  try {
    hexcal::hidden::Run();
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return 0;
}
