// SPDX-License-Identifier: BSD-3-Clause
// fuzz_data --reader=NAME [libFuzzer's flags] [CORPUS...]; without a name it lists the readers.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <string>

#include "fuzz/readers.h"

namespace {

// Of the processor's time: libFuzzer's own -timeout counts what others take, too.
constexpr int kLongestSeconds = 10;

const hexcal::fuzz::Reader* chosen = nullptr;
std::string folder;

void RemoveFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(folder, ignored);
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  static const std::vector<hexcal::fuzz::Reader> readers = hexcal::fuzz::FUZZ_READERS();
  constexpr const char* kFlag = "--reader=";
  for (int i = 1; i < *argc; ++i) {
    if (std::strncmp((*argv)[i], kFlag, std::strlen(kFlag)) != 0) continue;
    for (const auto& reader : readers)
      if (reader.name == (*argv)[i] + std::strlen(kFlag)) chosen = &reader;
  }
  if (chosen == nullptr) {
    for (const auto& reader : readers) std::printf("%s\n", reader.name.c_str());
    std::exit(0);
  }
  std::string name = (std::filesystem::temp_directory_path() / "hexcal_fuzz_XXXXXX").string();
  folder = mkdtemp(name.data());
  std::atexit(&RemoveFolder);
  hexcal::fuzz::WriteCompanions(folder);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::clock_t begin = std::clock();
  hexcal::fuzz::Meet(*chosen, folder, {reinterpret_cast<const char*>(data), size});
  if (std::clock() - begin > kLongestSeconds * CLOCKS_PER_SEC) {
    std::fprintf(stderr, "more than %d s of processor time\n", kLongestSeconds);
    std::abort();
  }
  return 0;
}
