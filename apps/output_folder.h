// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hexcal {

// A file that a command writes, and what the beginning of one of hexcal's own has in it. A file
// without a mark (a table) is hexcal's own where the first file of its folder is.
struct OutputFile {
  std::string name;
  std::string mark;
  // Of a page, whose mark the name of a command follows: the command that writes it here. One of
  // another command is kept beside it, as report-COMMAND.html.
  std::string command = {};
};

// What stands in the first bytes of each kind of file that hexcal writes.
inline constexpr std::string_view kResultMark = R"("format": "hexcal/result/)";
inline constexpr std::string_view kModelMark = "format: hexcal/model/";
inline constexpr std::string_view kPredictionMark = "pose,x,y,z,qw,qx,qy,qz\n";
inline constexpr std::string_view kSimulatedMark = "# Written by hexcal simulate";
inline constexpr std::string_view kImportedMark = "# Written by hexcal import";

// DIR/<name>/, where one command leaves its results of one dataset.
class OutputFolder {
 public:
  // Looks, before anything is computed, whether the files may be written: OutputError where a file
  // that hexcal did not write is in the way (unless force), where one is an input of this run (in
  // any case), and where a folder cannot be made or written to. Makes nothing yet.
  // dataset_name: the folder under out; empty: out itself.
  OutputFolder(const std::string& out,
               const std::string& dataset_name,
               const std::vector<OutputFile>& files,
               const std::vector<std::string>& inputs,
               bool force);

  // Makes the folder. All of the files (name, content) are written, or an OutputError is thrown and
  // all stand as before; interrupted or not. A warning says where a page of another command went.
  void Write(const std::vector<std::pair<std::string, std::string>>& files);

  const std::string& path() const { return path_; }
  std::string PathOf(const std::string& name) const;
  std::vector<std::string> PathsOf(
      const std::vector<std::pair<std::string, std::string>>& files) const;  // (name, content)

 private:
  // A page of another command: its name, that under which it is kept, and that command.
  struct KeptPage {
    std::string name, kept_as, command;
  };
  void CheckFile(const OutputFile& file, bool is_ours, bool force);
  void KeepOther(const OutputFile& page, bool force);

  std::string path_;
  std::vector<std::string> inputs_;
  std::vector<KeptPage> kept_;
};

// InputError where two of several datasets, (file, name) each, would write to the same folder.
void RequireDistinctNames(const std::vector<std::pair<std::string, std::string>>& datasets);

}  // namespace hexcal
