// SPDX-License-Identifier: BSD-3-Clause
#include "report/digest.h"

#include <fmt/format.h>
#include <glog/logging.h>
#include <openssl/evp.h>

#include <array>
#include <cstdint>
#include <memory>

#include "config/input_file.h"

namespace hexcal {
namespace {

constexpr std::size_t kPiece = 1 << 16;
constexpr std::int64_t kMostBytes = std::int64_t{1} << 40;

class Digest {
 public:
  Digest() : context_(EVP_MD_CTX_new(), &EVP_MD_CTX_free) {
    CHECK_EQ(EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr), 1);
  }
  void Add(std::string_view bytes) {
    CHECK_EQ(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()), 1);
  }
  std::string Hex() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
    unsigned int size = 0;
    CHECK_EQ(EVP_DigestFinal_ex(context_.get(), digest.data(), &size), 1);
    std::string hex;
    for (unsigned int i = 0; i < size; ++i) hex += fmt::format("{:02x}", digest[i]);
    return hex;
  }

 private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

}  // namespace

std::string Sha256(std::string_view bytes) {
  Digest digest;
  digest.Add(bytes);
  return digest.Hex();
}

std::vector<HashedFile> HashFiles(const std::vector<std::string>& paths) {
  std::vector<HashedFile> files;
  std::string piece(kPiece, '\0');
  for (const std::string& path : paths) {
    InputFile file(path, kMostBytes);
    Digest digest;
    while (const std::size_t size = file.Read(piece.data(), piece.size()))
      digest.Add({piece.data(), size});
    files.push_back({path, digest.Hex()});
  }
  return files;
}

}  // namespace hexcal
