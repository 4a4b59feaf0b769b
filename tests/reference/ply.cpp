// SPDX-License-Identifier: Apache-2.0
#include "ply.h"

#include <bit>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace recount {
namespace {

static_assert(std::endian::native == std::endian::little);

struct Property {
  std::string name, type;
  std::string length_type;  ///< the type of a list's length; empty if not a list
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

template <class T>
double read_as(std::istream& in) {
  T value{};
  in.read(reinterpret_cast<char*>(&value), sizeof value);
  return double(value);
}

double read_value(std::istream& in, const std::string& type) {
  if (type == "float" || type == "float32") return read_as<float>(in);
  if (type == "double" || type == "float64") return read_as<double>(in);
  if (type == "char" || type == "int8") return read_as<std::int8_t>(in);
  if (type == "uchar" || type == "uint8") return read_as<std::uint8_t>(in);
  if (type == "short" || type == "int16") return read_as<std::int16_t>(in);
  if (type == "ushort" || type == "uint16") return read_as<std::uint16_t>(in);
  if (type == "int" || type == "int32") return read_as<std::int32_t>(in);
  if (type == "uint" || type == "uint32") return read_as<std::uint32_t>(in);
  throw std::runtime_error("unknown property type " + type);
}

std::vector<Element> read_header(std::istream& in) {
  std::vector<Element> elements;
  bool little_endian = false;
  std::string line;
  std::getline(in, line);
  if (line != "ply") throw std::runtime_error("not a PLY file");
  while (std::getline(in, line) && line != "end_header") {
    std::istringstream words(line);
    std::string keyword, word;
    words >> keyword >> word;
    if (keyword == "format") {
      little_endian = word == "binary_little_endian";
    } else if (keyword == "element") {
      elements.push_back({word, 0, {}});
      words >> elements.back().count;
    } else if (keyword == "property") {
      if (elements.empty()) throw std::runtime_error("a property before the first element");
      Property property;
      property.type = word;
      if (word == "list") words >> property.length_type >> property.type;
      words >> property.name;
      elements.back().properties.push_back(property);
    }
  }
  if (!little_endian) throw std::runtime_error("not in binary_little_endian format");
  return elements;
}

void read_vertices(std::istream& in, const Element& element, Ply& ply) {
  ply.vertex_count = element.count;
  for (std::size_t i = 0; i < element.count; ++i) {
    for (const Property& property : element.properties) {
      const double value = read_value(in, property.type);
      if (!std::isfinite(value)) throw std::runtime_error("a value that is not finite");
      ply.properties[property.name].push_back(value);
    }
  }
}

void read_faces(std::istream& in, const Element& element, Ply& ply) {
  if (element.properties.size() != 1 || element.properties[0].length_type.empty()) {
    throw std::runtime_error("faces that are not one list of vertices");
  }
  const Property& list = element.properties[0];
  for (std::size_t i = 0; i < element.count; ++i) {
    std::vector<std::uint32_t> face(std::size_t(read_value(in, list.length_type)));
    for (std::uint32_t& vertex : face) {
      const double index = read_value(in, list.type);
      if (!(index >= 0 && index < double(ply.vertex_count))) {
        throw std::runtime_error("a face past the vertices");
      }
      vertex = std::uint32_t(index);
    }
    for (std::size_t k = 2; k < face.size(); ++k) {
      ply.triangles.push_back({face[0], face[k - 1], face[k]});
    }
  }
}

Ply parse(std::istream& in) {
  Ply ply;
  for (const Element& element : read_header(in)) {
    if (element.name == "vertex") {
      read_vertices(in, element, ply);
    } else if (element.name == "face") {
      read_faces(in, element, ply);
    } else {
      throw std::runtime_error("unknown element " + element.name);
    }
  }
  if (in.fail()) throw std::runtime_error("shorter than its header says");
  if (in.peek() != std::istream::traits_type::eof()) {
    throw std::runtime_error("longer than its header says");
  }
  return ply;
}

}  // namespace

const std::vector<double>& Ply::property(const std::string& name) const {
  const auto found = properties.find(name);
  if (found == properties.end()) throw std::runtime_error("PLY without the property " + name);
  return found->second;
}

std::vector<Point> Ply::points(const std::string& x, const std::string& y,
                               const std::string& z) const {
  const std::vector<double>&xs = property(x), &ys = property(y), &zs = property(z);
  std::vector<Point> points(vertex_count);
  for (std::size_t i = 0; i < vertex_count; ++i) points[i] = {xs[i], ys[i], zs[i]};
  return points;
}

Ply read_ply(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error(path.string() + ": cannot be opened");
  try {
    return parse(in);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
}

}  // namespace recount
