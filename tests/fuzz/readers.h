// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hexcal::fuzz {

// A reader that is given bytes from nobody knows where.
struct Reader {
  std::string name;
  std::string file;  // what the bytes are called in the folder that is read from
  void (*read)(const std::string& folder, const std::string& path, const Reader& self);
};

// Of datasets, models and other programs' files: what needs no solver.
std::vector<Reader> DataReaders();
// Of what a command takes beside its dataset.
std::vector<Reader> ReportReaders();
// Of the settings of commands, and of batches.
std::vector<Reader> ProgramReaders();

// The good files that a folder holds beside the fuzzed one.
void WriteCompanions(const std::string& folder);

// Ends the program where a terminal could not show it.
void CheckMessage(std::string_view message);

// Lets a reader meet bytes. It may take them, or refuse them with an InputError that a terminal can
// show: everything else ends the program. Whether it took them.
bool Meet(const Reader& reader, const std::string& folder, std::string_view bytes);

}  // namespace hexcal::fuzz
