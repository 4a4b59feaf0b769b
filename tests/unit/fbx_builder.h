// SPDX-License-Identifier: Apache-2.0
// Builds small FBX files, as text and binary.
#pragma once

#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace leafhull::test {

/// An FBX record: "Name: values { children }".
struct FbxRecord {
  using Value = std::variant<std::int32_t, std::int64_t, double, std::string, std::vector<double>,
                             std::vector<std::int32_t>>;

  FbxRecord(std::string of_name, std::vector<Value> with = {}, std::vector<FbxRecord> within = {})
      : name(std::move(of_name)), values(std::move(with)), children(std::move(within)) {}

  std::string name;
  std::vector<Value> values;
  std::vector<FbxRecord> children;
};

/// The record P: "Name", "type", "", "A", numbers.
inline FbxRecord property(const std::string& name, const std::string& type,
                          std::vector<double> numbers) {
  FbxRecord record("P", {name, type, std::string(), std::string("A")});
  for (const double number : numbers) {
    if (type == "int" || type == "enum" || type == "bool") {
      record.values.emplace_back(static_cast<std::int32_t>(number));
    } else {
      record.values.emplace_back(number);
    }
  }
  return record;
}

inline FbxRecord properties(std::vector<FbxRecord> list) {
  return {"Properties70", {}, std::move(list)};
}

/// The content of a file.
struct FbxBuilder {
  std::vector<FbxRecord> settings, objects, connections;

  /// Adds "Geometry", "Mesh", ... under a name; binary files write "name\0\1Class".
  FbxRecord& object(std::int64_t id, const std::string& kind, const std::string& name,
                    const std::string& type, std::vector<FbxRecord> children = {}) {
    return objects.emplace_back(kind, std::vector<FbxRecord::Value>{id, kind + "::" + name, type},
                                std::move(children));
  }
  void connect(std::int64_t child, std::int64_t parent) {
    connections.emplace_back("C", std::vector<FbxRecord::Value>{std::string("OO"), child, parent});
  }
  void connect(std::int64_t child, std::int64_t parent, const std::string& property_name) {
    connections.emplace_back(
        "C", std::vector<FbxRecord::Value>{std::string("OP"), child, parent, property_name});
  }

  std::vector<FbxRecord> document() const {
    return {{"FBXHeaderExtension", {}, {{"FBXVersion", {7400}}}},
            {"GlobalSettings", {}, {{"Version", {1000}}, properties(settings)}},
            {"Objects", {}, objects},
            {"Connections", {}, connections}};
  }

  std::string ascii() const {
    std::ostringstream stream;
    stream.precision(17);
    stream << "; FBX 7.4.0 project file\n";
    for (const FbxRecord& record : document()) write_ascii(stream, record);
    return stream.str();
  }

  std::string binary() const {
    std::string bytes("Kaydara FBX Binary  \0\x1a\0", 23);
    put(bytes, std::uint32_t{7400});
    for (const FbxRecord& record : document()) write_binary(bytes, record);
    bytes.append(13, '\0');
    return bytes;
  }

 private:
  template <class T>
  static void put(std::string& bytes, T value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
  }

  static void write_ascii(std::ostream& stream, const FbxRecord& record) {
    stream << record.name << ": ";
    for (std::size_t i = 0; i < record.values.size(); ++i) {
      if (i > 0) stream << ", ";
      std::visit([&](const auto& value) { write_value(stream, value); }, record.values[i]);
    }
    if (!record.children.empty() || record.values.empty()) {
      stream << " {\n";
      for (const FbxRecord& child : record.children) write_ascii(stream, child);
      stream << '}';
    }
    stream << '\n';
  }
  template <class T>
  static void write_value(std::ostream& stream, const T& value) {
    if constexpr (std::is_same_v<T, std::string>) {
      stream << '"' << value << '"';
    } else if constexpr (std::is_arithmetic_v<T>) {
      stream << value;
    } else {
      stream << '*' << value.size() << " {\na: ";
      for (std::size_t i = 0; i < value.size(); ++i) stream << (i > 0 ? "," : "") << value[i];
      stream << "\n}";
    }
  }

  static void write_binary(std::string& bytes, const FbxRecord& record) {
    const std::size_t begin = bytes.size();
    bytes.append(12, '\0');
    bytes += static_cast<char>(record.name.size());
    bytes += record.name;
    const std::size_t values = bytes.size();
    for (const FbxRecord::Value& value : record.values) {
      std::visit([&](const auto& v) { put_value(bytes, v); }, value);
    }
    const std::size_t values_end = bytes.size();
    for (const FbxRecord& child : record.children) write_binary(bytes, child);
    if (!record.children.empty()) bytes.append(13, '\0');
    const auto put_at = [&](std::size_t at, std::size_t number) {
      const auto value = static_cast<std::uint32_t>(number);
      std::memcpy(bytes.data() + at, &value, sizeof value);
    };
    put_at(begin, bytes.size());
    put_at(begin + 4, record.values.size());
    put_at(begin + 8, values_end - values);
  }
  static void put_value(std::string& bytes, std::int32_t v) { bytes += 'I', put(bytes, v); }
  static void put_value(std::string& bytes, std::int64_t v) { bytes += 'L', put(bytes, v); }
  static void put_value(std::string& bytes, double v) { bytes += 'D', put(bytes, v); }
  static void put_value(std::string& bytes, std::string v) {
    if (const std::size_t colon = v.find("::"); colon != std::string::npos) {
      v = v.substr(colon + 2) + std::string("\0\1", 2) + v.substr(0, colon);
    }
    bytes += 'S';
    put(bytes, static_cast<std::uint32_t>(v.size()));
    bytes += v;
  }
  template <class T>
  static void put_value(std::string& bytes, const std::vector<T>& list) {
    bytes += std::is_same_v<T, double> ? 'd' : 'i';
    put(bytes, static_cast<std::uint32_t>(list.size()));
    put(bytes, std::uint32_t{0});
    put(bytes, static_cast<std::uint32_t>(list.size() * sizeof(T)));
    for (const T v : list) put(bytes, v);
  }
};

}  // namespace leafhull::test
