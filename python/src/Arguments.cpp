// SPDX-License-Identifier: MIT
#include "Arguments.h"

#include "allpairs/Error.h"

namespace allpairs::python {
namespace py = pybind11;
namespace {

bool hasShape(const py::buffer_info& info, py::ssize_t columns) {
  return columns == 0 ? info.ndim == 1 : info.ndim == 2 && info.shape[1] == columns;
}

bool hasWholeStrides(const py::buffer_info& info) {
  for (const py::ssize_t stride : info.strides) {
    if (stride % info.itemsize != 0) return false;
  }
  return true;
}

}  // namespace

py::buffer_info requestBuffer(const py::buffer& buffer, const BufferShape& shape) {
  py::buffer_info info = buffer.request();
  if (info.format != shape.format || !hasShape(info, shape.columns) || !hasWholeStrides(info)) {
    throw InvalidArgument("a buffer of another kind than the module takes");
  }
  return info;
}

bool isFloat32(const py::buffer& buffer) { return buffer.request().format == "f"; }

}  // namespace allpairs::python
