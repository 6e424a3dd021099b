// SPDX-License-Identifier: MIT
#include "ElementBoxes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "allpairs/Error.h"

namespace allpairs::elements {
namespace {

constexpr std::size_t indexOf(ElementKind kind) { return static_cast<std::size_t>(kind); }

[[noreturn]] void fail(std::size_t mesh, const std::string& problem) {
  throw InvalidArgument("mesh " + std::to_string(mesh) + ": " + problem);
}

template <class T>
void checkPositions(std::size_t mesh, std::span<const T> values, std::size_t vertices, const char* when) {
  if (values.size() != 3 * vertices) {
    fail(mesh, "its positions at the " + std::string(when) + " are " + std::to_string(values.size()) +
                   " numbers where " + std::to_string(vertices) + " vertices need " + std::to_string(3 * vertices));
  }
  const auto bad = std::find_if(values.begin(), values.end(), [](T value) { return !std::isfinite(value); });
  if (bad == values.end()) return;
  fail(mesh, "vertex " + std::to_string((bad - values.begin()) / 3) + " has a coordinate at the " + when +
                 " that is no finite number");
}

template <class T>
void include(BasicBox<T>& box, const BasicBox<T>& other) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.min[axis] = std::min(box.min[axis], other.min[axis]);
    box.max[axis] = std::max(box.max[axis], other.max[axis]);
  }
}

/// The boxes around the vertices of each element.
template <class T, class Element>
void boundElements(Span<const Element> elements, std::span<const BasicBox<T>> vertices,
                   std::vector<BasicBox<T>>& boxes) {
  boxes.resize(elements.size());
  for (std::size_t i = 0; i < elements.size(); ++i) {
    BasicBox<T> box = vertices[elements[i][0]];
    for (std::size_t k = 1; k < elements[i].size(); ++k) include(box, vertices[elements[i][k]]);
    boxes[i] = box;
  }
}

/// The nearest float32, kept within the finite ones.
float nearest(double value) {
  constexpr auto kMost = static_cast<double>(std::numeric_limits<float>::max());
  return static_cast<float>(std::clamp(value, -kMost, kMost));
}

/// Returns whether rounding changed nothing.
bool roundBox(const Box& box, BoxF& rounded) {
  bool exact = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    rounded.min[axis] = nearest(box.min[axis]);
    rounded.max[axis] = nearest(box.max[axis]);
    exact &= (static_cast<double>(rounded.min[axis]) == box.min[axis]) &
             (static_cast<double>(rounded.max[axis]) == box.max[axis]);
  }
  return exact;
}

}  // namespace

ElementBoxes::ElementBoxes(const MeshTopology& topology)
    : m_topology(topology), m_meshIsExact(topology.meshCount(), true) {
  m_rounded.boxes[indexOf(ElementKind::Vertices)].resize(topology.counts().vertices);
  m_exact.boxes[indexOf(ElementKind::Vertices)].resize(topology.counts().vertices);
}

template <class T>
void ElementBoxes::setPositions(std::size_t mesh, std::span<const T> start, std::span<const T> end) {
  const std::size_t count = m_topology.vertexCount(mesh);
  const std::size_t first = m_topology.before(mesh).vertices;
  checkPositions(mesh, start, count, "start");
  checkPositions(mesh, end, count, "end");
  bool exact = true;
  for (std::size_t v = 0; v < count; ++v) {
    Box& box = m_exact.boxes[indexOf(ElementKind::Vertices)][first + v];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<double>(start[3 * v + axis]);
      const auto b = static_cast<double>(end[3 * v + axis]);
      box.min[axis] = std::min(a, b);
      box.max[axis] = std::max(a, b);
    }
    exact &= roundBox(box, m_rounded.boxes[indexOf(ElementKind::Vertices)][first + v]);
  }
  m_meshIsExact[mesh] = exact;
  m_rounded.areCurrent = {};
  m_exact.areCurrent = {};
  m_lanesAreCurrent = {};
}

template void ElementBoxes::setPositions(std::size_t, std::span<const float>, std::span<const float>);
template void ElementBoxes::setPositions(std::size_t, std::span<const double>, std::span<const double>);

bool ElementBoxes::roundedAreExact() const noexcept {
  return std::find(m_meshIsExact.begin(), m_meshIsExact.end(), false) == m_meshIsExact.end();
}

template <class T>
std::span<const BasicBox<T>> ElementBoxes::current(Tables<T>& tables, ElementKind kind) const {
  // Rounding is monotone: the rounded box of an element is that of its vertices' rounded boxes.
  const std::span<const BasicBox<T>> vertices = tables.boxes[indexOf(ElementKind::Vertices)];
  std::vector<BasicBox<T>>& boxes = tables.boxes[indexOf(kind)];
  bool& isCurrent = tables.areCurrent[indexOf(kind)];
  if (kind == ElementKind::Edges && !isCurrent) boundElements(m_topology.edges(), vertices, boxes);
  if (kind == ElementKind::Faces && !isCurrent) boundElements(m_topology.triangles(), vertices, boxes);
  isCurrent = true;
  return boxes;
}

std::span<const BoxF> ElementBoxes::rounded(ElementKind kind) { return current(m_rounded, kind); }

std::span<const Box> ElementBoxes::exact(ElementKind kind) { return current(m_exact, kind); }

std::span<const LaneBounds> ElementBoxes::lanes(ElementKind kind) {
  std::vector<LaneBounds>& lanes = m_lanes[indexOf(kind)];
  if (!m_lanesAreCurrent[indexOf(kind)]) {
    const std::span<const BoxF> boxes = rounded(kind);
    lanes.clear();
    lanes.reserve(boxes.size());
    for (const BoxF& box : boxes) lanes.emplace_back(box);
  }
  m_lanesAreCurrent[indexOf(kind)] = true;
  return lanes;
}

}  // namespace allpairs::elements
