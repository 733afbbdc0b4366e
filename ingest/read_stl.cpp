// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/read_stl.hpp"

#include <bit>
#include <cstring>
#include <unordered_map>

#include "ingest/mesh_faces.hpp"
#include "ingest/number_type.hpp"
#include "ingest/text_scanner.hpp"

namespace scarp {
namespace {

constexpr std::size_t kBinaryHeader = 84;  // 80 bytes of text, then the number of triangles
constexpr std::size_t kBinaryRecord = 50;  // normal, three corners, two bytes of attributes

struct VertexHash {
  std::size_t operator()(const Vec3& v) const {
    std::uint64_t hash = 0;
    for (double c : v) hash = (hash ^ std::bit_cast<std::uint64_t>(c)) * 0x9E3779B97F4A7C15u;
    return hash ^ hash >> 32;
  }
};

/// Gives equal vertices one index.
class Welder {
 public:
  explicit Welder(TriangleMesh& mesh) : mesh_(mesh) {}

  std::uint32_t index(Vec3 vertex, const SourceLocation& where) {
    check_vertex(vertex, where);
    for (double& c : vertex) c += 0.0;  // -0 equals 0
    const auto [entry, is_new] = indices_.try_emplace(vertex, static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (is_new) mesh_.vertices.push_back(vertex);
    return entry->second;
  }

 private:
  TriangleMesh& mesh_;
  std::unordered_map<Vec3, std::uint32_t, VertexHash> indices_;
};

TriangleMesh read_binary(BufferedFile& file) {
  const auto count = static_cast<std::uint64_t>(load_number(file.take(kBinaryHeader) + 80, NumberType::u32, false));
  if (count != file.bytes_left() / kBinaryRecord || file.bytes_left() % kBinaryRecord != 0)
    throw Error("ingest", "size of a binary STL file", std::to_string(file.size()) + " bytes",
                std::to_string(kBinaryHeader + count * kBinaryRecord) + " for its " + std::to_string(count) +
                    " triangles; or \"solid\" first, as text",
                file.at_byte());
  TriangleMesh mesh;
  Welder welder(mesh);
  mesh.triangles.reserve(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    const char* bytes = file.take(kBinaryRecord);
    std::array<std::uint32_t, 3> triangle;
    for (int k = 0; k < 3; ++k) {
      Vec3 corner;
      for (int a = 0; a < 3; ++a) corner[a] = load_number(bytes + 12 * (k + 1) + 4 * a, NumberType::f32, false);
      triangle[k] = welder.index(corner, file.at_byte());
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

/// Lines that carry no corner.
bool is_frame(std::string_view word) {
  for (std::string_view known : {"solid", "facet", "outer", "endloop", "endfacet", "endsolid"})
    if (word == known) return true;
  return false;
}

TriangleMesh read_ascii(BufferedFile& file) {
  TriangleMesh mesh;
  Welder welder(mesh);
  std::vector<double> corners, numbers;
  bool closed = false;
  std::string_view line;
  while (file.next_line(line)) {
    const std::vector<std::string_view> words = split(line, ' ');
    if (words.empty()) continue;
    const std::string word = lower_case(words[0]);
    closed = word == "endsolid";
    if (word == "vertex") {
      const std::string_view rest = line.substr(static_cast<std::size_t>(words[0].data() - line.data()) + 6);
      read_numbers(rest, ' ', file, numbers);
      if (numbers.size() != 3)
        throw Error("ingest", "corner of a triangle", shown(line), "vertex X Y Z", file.at_line());
      corners.push_back(welder.index({numbers[0], numbers[1], numbers[2]}, file.at_line()));
    } else if (!is_frame(word)) {
      throw Error("ingest", "line that does not belong in an STL file", shown(line), {}, file.at_line());
    } else if (word == "endfacet") {
      if (corners.size() != 3)
        throw Error("ingest", "corners of a triangle", std::to_string(corners.size()), "3", file.at_line());
      add_face(corners, mesh.vertices.size(), file.at_line(), mesh);
      corners.clear();
    }
  }
  if (!closed) throw Error("ingest", "STL file ends without endsolid", {}, {}, file.at_line());
  return mesh;
}

}  // namespace

bool is_binary_stl(BufferedFile& file) {
  const std::string_view beginning = file.peek();
  if (beginning.size() < kBinaryHeader) return false;
  const double count = load_number(beginning.data() + 80, NumberType::u32, false);
  return static_cast<double>(file.size()) == kBinaryHeader + kBinaryRecord * count;
}

TriangleMesh read_stl(BufferedFile& file) {
  if (is_binary_stl(file)) return read_binary(file);
  if (lower_case(trimmed(file.peek().substr(0, 16))).starts_with("solid")) return read_ascii(file);
  return read_binary(file);
}

}  // namespace scarp
