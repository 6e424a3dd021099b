// SPDX-License-Identifier: MIT
#include "Boxes.h"

#include <utility>

#include "Arguments.h"
#include "Gil.h"
#include "allpairs/Error.h"

namespace allpairs::python {
namespace py = pybind11;
namespace {

template <class T>
BoxView setOf(const py::buffer_info& lower, const py::buffer_info& upper) {
  return BoxView::fromStrided(static_cast<std::size_t>(lower.shape[0]), cornersOf<T>(lower), cornersOf<T>(upper));
}

/// Runs what may throw InvalidBox without the GIL, and says of which set the box is.
template <class Work>
void runLabelled(const std::string& label, const Work& work) {
  const ReleasedGil released;
  try {
    work();
  } catch (const InvalidBox& error) {
    throw InvalidBox(error.index(), label + error.what());
  }
}

}  // namespace

Boxes::Boxes(const py::buffer& lower, const py::buffer& upper, std::string label) : m_label(std::move(label)) {
  const bool single = isFloat32(lower);
  const BufferShape shape{single ? "f" : "d", 3};
  m_held.push_back(requestBuffer(lower, shape));
  m_held.push_back(requestBuffer(upper, shape));
  if (m_held[0].shape[0] != m_held[1].shape[0]) throw InvalidArgument("lower and upper differ in length");
  runLabelled(m_label,
              [&] { m_set = single ? setOf<float>(m_held[0], m_held[1]) : setOf<double>(m_held[0], m_held[1]); });
}

void Boxes::setMargins(const py::buffer& margins) {
  m_held.push_back(requestBuffer(margins, {"d", 0}));
  runLabelled(m_label, [&] { m_set.setMargins(valuesOf<double>(m_held.back())); });
}

}  // namespace allpairs::python
