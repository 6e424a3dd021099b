// SPDX-License-Identifier: MIT
#include "sofa/mesh/VtkCells.h"

#include <algorithm>

namespace allpairs::scene::sofa {
namespace {

// VTK's numbers for the types of cells.
constexpr std::int64_t kPolyVertex = 2;  // Those below are a point and nothing.
constexpr std::int64_t kLine = 3;
constexpr std::int64_t kPolyLine = 4;
constexpr std::int64_t kTriangle = 5;
constexpr std::int64_t kTriangleStrip = 6;
constexpr std::int64_t kPolygon = 7;
constexpr std::int64_t kPixel = 8;
constexpr std::int64_t kQuad = 9;
constexpr std::int64_t kTetrahedron = 10;
constexpr std::int64_t kVoxel = 11;
constexpr std::int64_t kHexahedron = 12;
constexpr std::int64_t kQuadraticEdge = 21;
constexpr std::int64_t kQuadraticTriangle = 22;
constexpr std::int64_t kQuadraticTetrahedron = 24;

std::size_t cornersNeeded(std::int64_t type) {
  switch (type) {
    case kLine:
      return 2;
    case kTriangle:
    case kQuadraticEdge:
      return 3;
    case kPixel:
    case kQuad:
    case kTetrahedron:
      return 4;
    case kQuadraticTriangle:
      return 6;
    case kVoxel:
    case kHexahedron:
      return 8;
    case kQuadraticTetrahedron:
      return 10;
    default:
      return 0;
  }
}

}  // namespace

bool VtkCells::add(std::int64_t type, std::span<const Index> corners) {
  if (corners.size() < cornersNeeded(type)) return false;
  if (type >= kQuadraticEdge)
    addQuadratic(type, corners);
  else
    addLinear(type, corners);
  return true;
}

std::int64_t VtkCells::typeOfPolygon(std::size_t corners) {
  switch (corners) {
    case 2:
      return kLine;
    case 3:
      return kTriangle;
    case 4:
      return kQuad;
    default:
      return kPolyLine;
  }
}

void VtkCells::addPolygon(std::span<const Index> c) {
  if (c.size() == 4)
    m_mesh.quads.push_back({c[0], c[1], c[2], c[3]});
  else
    addFan(c);
}

void VtkCells::addLinear(std::int64_t type, std::span<const Index> c) {
  switch (type) {
    case kLine:
      m_mesh.edges.push_back({c[0], c[1]});
      break;
    case kTriangle:
      m_mesh.triangles.push_back({c[0], c[1], c[2]});
      break;
    case kTriangleStrip:
      addStrip(c);
      break;
    case kPolygon:
      addFan(c);
      break;
    case kPixel:
      m_mesh.quads.push_back({c[0], c[1], c[3], c[2]});
      break;
    case kQuad:
      m_mesh.quads.push_back({c[0], c[1], c[2], c[3]});
      break;
    case kTetrahedron:
      m_mesh.tetrahedra.push_back({c[0], c[1], c[2], c[3]});
      break;
    case kVoxel:
      m_mesh.hexahedra.push_back({c[0], c[1], c[3], c[2], c[4], c[5], c[7], c[6]});
      break;
    case kHexahedron:
      m_mesh.hexahedra.push_back({c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7]});
      break;
    default:
      if (type < 0 || type > kPolyVertex) ++m_mesh.passedOver;
      break;
  }
}

void VtkCells::addQuadratic(std::int64_t type, std::span<const Index> c) {
  const auto addEdge = [&](Index a, Index b) {
    const auto edge = sorted<2>({a, b});
    if (m_edges.insert(edge).second) m_mesh.edges.push_back(edge);
  };
  if (cornersNeeded(type) == 0) ++m_mesh.passedOver;
  if (type == kQuadraticEdge) m_mesh.edges.push_back({c[0], c[1]});
  if (type == kQuadraticTriangle) {
    m_mesh.triangles.push_back({c[0], c[1], c[2]});
    for (std::size_t i = 0; i < 3; ++i) addEdge(c[i], c[(i + 1) % 3]);
  }
  if (type == kQuadraticTetrahedron) {
    m_mesh.tetrahedra.push_back({c[0], c[1], c[2], c[3]});
    for (std::size_t i = 0; i < 3; ++i) addEdge(c[i], c[(i + 1) % 3]);
    for (std::size_t i = 0; i < 3; ++i) addEdge(c[i], c[3]);
  }
}

void VtkCells::addFan(std::span<const Index> c) {
  if (c.size() < 3) ++m_mesh.passedOver;
  for (std::size_t i = 2; i < c.size(); ++i) m_mesh.triangles.push_back({c[0], c[i - 1], c[i]});
}

void VtkCells::addStrip(std::span<const Index> c) {
  if (c.size() < 3) ++m_mesh.passedOver;
  for (std::size_t i = 2; i < c.size(); ++i)
    if (i % 2 == 1)
      m_mesh.triangles.push_back({c[i - 2], c[i - 1], c[i]});
    else
      m_mesh.triangles.push_back({c[i - 2], c[i], c[i - 1]});
}

}  // namespace allpairs::scene::sofa
