// SPDX-License-Identifier: BSD-3-Clause
#include "batch/write_csv.h"

#include "batch/csv.h"
#include "config/atomic_file.h"

namespace hexcal {
namespace {

constexpr std::size_t kPiece = 1 << 16;

}  // namespace

void WriteCsv(const std::string& path, const Batch& batch, Store* store) {
  AtomicFile file(path);
  std::string piece = CsvHeader(AllColumns(*batch.job));
  store->ForEach([&](const Row& row) {
    AppendCsvLine(batch.name, row, &piece);
    if (piece.size() < kPiece) return;
    file.Write(piece);
    piece.clear();
  });
  file.Write(piece);
  file.Commit();
}

}  // namespace hexcal
