#include "core/errors.h"
#include "volume/file_checks.h"
#include "volume/read.h"

#include <openssl/evp.h>

#include <array>
#include <fstream>
#include <memory>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

using Digest = std::array<unsigned char, 32>;

struct FreeContext {
  void operator()(EVP_MD_CTX* context) const { EVP_MD_CTX_free(context); }
};

/// A running SHA-256.
class Hash {
public:
  Hash() : context_(EVP_MD_CTX_new()) {
    if (!context_ || EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) != 1)
      throw Error("SHA-256 cannot be computed: OpenSSL refuses it");
  }
  void add(const void* bytes, std::size_t count) { EVP_DigestUpdate(context_.get(), bytes, count); }
  Digest finish() {
    Digest digest{};
    unsigned length = 0;
    EVP_DigestFinal_ex(context_.get(), digest.data(), &length);
    return digest;
  }

private:
  std::unique_ptr<EVP_MD_CTX, FreeContext> context_;
};

Digest digest_of(const fs::path& path) {
  require_file(path);
  std::ifstream in(path, std::ios::binary);
  if (!in)
    throw FileError(path.string(), "cannot be opened");
  Hash hash;
  std::vector<char> buffer(std::size_t{1} << 20);
  while (in.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) || in.gcount() > 0)
    hash.add(buffer.data(), static_cast<std::size_t>(in.gcount()));
  if (in.bad())
    throw FileError(path.string(), "cannot be read in full");
  return hash.finish();
}

std::string hexadecimal(const Digest& digest) {
  std::string text;
  for (const unsigned char byte : digest) {
    text += "0123456789abcdef"[byte >> 4];
    text += "0123456789abcdef"[byte & 15];
  }
  return text;
}

} // namespace

std::string sha256_of(const std::vector<fs::path>& files) {
  Digest digest{};
  if (files.size() == 1) {
    digest = digest_of(files.front());
  } else {
    Hash all;
    for (const fs::path& file : files) {
      const Digest one = digest_of(file);
      all.add(one.data(), one.size());
    }
    digest = all.finish();
  }
  return hexadecimal(digest);
}

std::string sha256_of_text(const std::string& text) {
  Hash hash;
  hash.add(text.data(), text.size());
  return hexadecimal(hash.finish());
}

} // namespace slicelens
