// SPDX-License-Identifier: BSD-3-Clause
#include "report/digest.h"

#include <gtest/gtest.h>

#include "config/input_error.h"
#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

// FIPS 180-4's own examples.
TEST(Digest, IsSha256) {
  EXPECT_EQ(Sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(Sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(Digest, OfFilesIsThatOfTheirBytes) {
  testing::TemporaryFolder folder;
  const std::string large(200000, 'x');
  const auto files =
      HashFiles({folder.Write("a", "abc"), folder.Write("b", large), folder.Write("c", "")});
  EXPECT_EQ(files[0].sha256, Sha256("abc"));
  EXPECT_EQ(files[1].sha256, Sha256(large));
  EXPECT_EQ(files[2].sha256, Sha256(""));
  EXPECT_THROW(HashFiles({folder.Path("none")}), InputError);
}

}  // namespace
}  // namespace hexcal
