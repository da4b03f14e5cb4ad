// Numbers and lists as bytes in a file, and back, in the machine's byte order. Private to src/volume.
#pragma once

#include "core/errors.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace slicelens {

class ByteWriter {
public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_arithmetic_v<T>);
    add(&value, sizeof(T));
  }
  template <class T>
  void put_list(const std::vector<T>& values) {
    put(static_cast<std::uint64_t>(values.size()));
    add(values.data(), values.size() * sizeof(T));
  }
  void put_text(const std::string& text) { put_list(std::vector<char>(text.begin(), text.end())); }

  const std::vector<std::byte>& bytes() const { return bytes_; }

private:
  void add(const void* from, std::size_t count) {
    const std::size_t old = bytes_.size();
    bytes_.resize(old + count);
    if (count > 0)
      std::memcpy(bytes_.data() + old, from, count);
  }

  std::vector<std::byte> bytes_;
};

/// Throws FileError naming `path` where the bytes end too early. Lists are no longer than the bytes are.
class ByteReader {
public:
  ByteReader(std::span<const std::byte> bytes, std::string path) : bytes_(bytes), path_(std::move(path)) {}

  template <class T>
  T get() {
    static_assert(std::is_arithmetic_v<T>);
    T value{};
    std::memcpy(&value, take(sizeof(T)), sizeof(T));
    return value;
  }
  template <class T>
  std::vector<T> get_list() {
    const auto count = get<std::uint64_t>();
    if (count > bytes_.size() / sizeof(T))
      damaged();
    std::vector<T> values(static_cast<std::size_t>(count));
    if (count > 0)
      std::memcpy(values.data(), take(values.size() * sizeof(T)), values.size() * sizeof(T));
    return values;
  }
  std::string get_text() {
    const std::vector<char> text = get_list<char>();
    return {text.begin(), text.end()};
  }

  bool at_end() const { return bytes_.empty(); }
  [[noreturn]] void damaged() const { throw FileError(path_, "its header is damaged; delete the file"); }

private:
  const std::byte* take(std::size_t count) {
    if (count > bytes_.size())
      damaged();
    const std::byte* const from = bytes_.data();
    bytes_ = bytes_.subspan(count);
    return from;
  }

  std::span<const std::byte> bytes_;
  std::string path_;
};

} // namespace slicelens
