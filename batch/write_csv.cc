// SPDX-License-Identifier: BSD-3-Clause
#include "batch/write_csv.h"

#include <future>

#include "batch/csv.h"
#include "config/atomic_file.h"

namespace hexcal {
namespace {

constexpr std::int64_t kPiece = 256;  // rows: some hundred kB

std::string PieceOf(const Batch& batch, Store* store, std::int64_t first) {
  std::string piece;
  store->ForEach(
      first, first + kPiece, [&](const Row& row) { AppendCsvLine(batch.name, row, &piece); });
  return piece;
}

}  // namespace

void WriteCsv(const std::string& path, const Batch& batch, const std::vector<Store*>& stores) {
  AtomicFile file(path);
  file.Write(CsvHeader(AllColumns(*batch.job)));
  const std::launch how = stores.size() > 1 ? std::launch::async : std::launch::deferred;
  for (std::int64_t first = 0; first < batch.rows();) {
    std::vector<std::future<std::string>> pieces;
    for (Store* store : stores) {
      pieces.push_back(
          std::async(how, [&batch, store, first] { return PieceOf(batch, store, first); }));
      first += kPiece;
    }
    for (std::future<std::string>& piece : pieces) file.Write(piece.get());
  }
  file.Commit();
}

}  // namespace hexcal
