#include "files.h"

#include <unistd.h>

#include <charconv>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "mspskel/base/error.h"

namespace mspskel::cli {
namespace {

std::string number(double x) {
  char digits[32];
  return std::string(digits, std::to_chars(digits, digits + sizeof digits, x).ptr);
}

std::string blank_separated(const Vector3& p) {
  return number(p.x()) + " " + number(p.y()) + " " + number(p.z());
}

std::string extension(const std::string& path) { return std::filesystem::path(path).extension().string(); }

}  // namespace

void write_file(const std::string& path, const std::string& bytes) {
  if (path == "-") {
    std::cout << bytes << std::flush;
    if (!std::cout) throw WriteError("cannot write to stdout");
    return;
  }
  const std::string temporary = path + ".tmp" + std::to_string(getpid());
  std::ofstream file(temporary, std::ios::binary);
  file << bytes;
  file.close();
  if (!file || std::rename(temporary.c_str(), path.c_str()) != 0) {
    std::remove(temporary.c_str());
    throw WriteError("cannot write " + path);
  }
}

void skeleton_format_of(const std::string& path) {
  if (path == "-") return;
  if (extension(path) != ".skel" && extension(path) != ".obj")
    throw UsageError(path + ": skeletons are written as .skel or .obj");
}

void write_skeleton(const std::string& path, const CurveSkeleton& skeleton) {
  std::string text;
  if (extension(path) == ".obj") {
    for (const SkeletonNode& node : skeleton.nodes) text += "v " + blank_separated(node.position) + "\n";
    for (const auto& [a, b] : skeleton.edges)
      text += "l " + std::to_string(a + 1) + " " + std::to_string(b + 1) + "\n";
  } else {
    text = "ID Cx Cy Cz RADIUS #NEIGHBORS NEIGHBORS_LIST\n" + std::to_string(skeleton.nodes.size()) + "\n";
    const auto next = adjacency(skeleton);
    for (std::size_t i = 0; i < skeleton.nodes.size(); ++i) {
      text += std::to_string(i) + " " + blank_separated(skeleton.nodes[i].position) + " " +
              number(skeleton.nodes[i].radius) + " " + std::to_string(next[i].size());
      for (const Index j : next[i]) text += " " + std::to_string(j);
      text += "\n";
    }
  }
  write_file(path, text);
}

CurveSkeleton read_skeleton(const std::string& path) {
  std::ifstream file(path);
  std::string header;
  std::getline(file, header);
  Index count = 0;
  file >> count;
  CurveSkeleton skeleton;
  for (Index i = 0; i < count && file; ++i) {
    SkeletonNode node;
    Index id = 0, neighbours = 0;
    file >> id >> node.position.x() >> node.position.y() >> node.position.z() >> node.radius >> neighbours;
    skeleton.nodes.push_back(node);
    for (Index k = 0; k < neighbours && file; ++k) {
      Index j = 0;
      file >> j;
      if (j > i) skeleton.edges.push_back({i, j});
    }
  }
  if (!file) throw ReadError(path + ": not a .skel file");
  return skeleton;
}

void write_mesh(const std::string& path, const PolygonSoup& soup) {
  std::string text =
      "OFF\n" + std::to_string(soup.points.size()) + " " + std::to_string(soup.polygon_count()) + " 0\n";
  for (const Vector3& p : soup.points) text += blank_separated(p) + "\n";
  for (std::size_t f = 0; f < soup.polygon_count(); ++f) {
    text += std::to_string(soup.begin[f + 1] - soup.begin[f]);
    for (Index c = soup.begin[f]; c < soup.begin[f + 1]; ++c) text += " " + std::to_string(soup.corners[c]);
    text += "\n";
  }
  write_file(path, text);
}

}  // namespace mspskel::cli
