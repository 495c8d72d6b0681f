// The part of NumPy's .npy format that tests need, written without the library: little-endian, C order, version 1.0.
#pragma once

#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace bihive::test {

/// `descr` as NumPy spells it, "<f4"; `columns` 0 makes a one-dimensional array. False if the file cannot be written.
template <class T>
bool write_npy(const std::string& path, const std::string& descr, const std::vector<T>& values, std::size_t columns) {
  const std::size_t rows = columns == 0 ? values.size() : values.size() / columns;
  std::string header = "{'descr': '" + descr + "', 'fortran_order': False, 'shape': (" + std::to_string(rows) + "," +
                       (columns == 0 ? "" : " " + std::to_string(columns)) + "), }";
  while ((10 + header.size() + 1) % 64 != 0) header += ' ';
  header += '\n';
  std::ofstream file(path, std::ios::binary);
  file.write("\x93NUMPY\x01\x00", 8);
  const char length[2] = {static_cast<char>(header.size() & 255), static_cast<char>(header.size() >> 8)};
  file.write(length, 2);
  file << header;
  file.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(T)));
  return file.good();
}

/// A one-dimensional array of exactly this type and length; empty if the file is anything else.
template <class T>
std::vector<T> read_npy(const std::string& path, const std::string& descr, std::size_t count) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream buffer;
  buffer << file.rdbuf();
  const std::string bytes = buffer.str();
  if (bytes.size() < 10 || bytes.compare(0, 6, "\x93NUMPY") != 0) return {};
  const std::size_t start = 10 + static_cast<std::uint8_t>(bytes[8]) + 256u * static_cast<std::uint8_t>(bytes[9]);
  if (start > bytes.size()) return {};
  const std::string header = bytes.substr(10, start - 10);
  if (header.find("'" + descr + "'") == std::string::npos || header.find("True") != std::string::npos) return {};
  if (header.find("(" + std::to_string(count) + ",)") == std::string::npos) return {};
  if (bytes.size() - start != count * sizeof(T)) return {};
  std::vector<T> values(count);
  std::memcpy(values.data(), bytes.data() + start, count * sizeof(T));
  return values;
}

}  // namespace bihive::test
