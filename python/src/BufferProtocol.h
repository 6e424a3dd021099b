// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <type_traits>

namespace allpairs::python {

/// Numbers in memory as Python's buffer protocol describes them, in one or two dimensions.
struct Table {
  void* data = nullptr;
  char format[2] = {};
  pybind11::ssize_t itemSize = 0;
  int dimensions = 0;
  std::array<pybind11::ssize_t, 2> shape{};
  std::array<pybind11::ssize_t, 2> strides{};  ///< In bytes.
  bool isReadOnly = false;
};

/// Rows of numbers one after the other; no rows but a list for 0 columns.
template <class T>
Table tableOf(T* data, std::size_t size, pybind11::ssize_t columns) {
  constexpr bool kIsInteger = std::is_same_v<T, std::uint32_t> || std::is_same_v<T, std::uint64_t>;
  static_assert(kIsInteger || std::is_same_v<T, float> || std::is_same_v<T, double>);
  constexpr char kFormat = kIsInteger ? (sizeof(T) == 4 ? 'I' : 'Q') : std::is_same_v<T, float> ? 'f' : 'd';
  constexpr auto kSize = static_cast<pybind11::ssize_t>(sizeof(T));
  const auto count = static_cast<pybind11::ssize_t>(size);
  Table table{.data = data, .format = {kFormat, '\0'}, .itemSize = kSize, .dimensions = columns == 0 ? 1 : 2};
  table.shape = {columns == 0 ? count : count / columns, columns};
  table.strides = {kSize * std::max(columns, pybind11::ssize_t{1}), kSize};
  return table;
}

/// Gives the table of an object whose class has a member function table(), which lives as long as the object. It
/// allocates nothing: of an object that fails to give its buffer NumPy silently makes an array of one object.
template <class T>
int getTable(PyObject* object, Py_buffer* view, int flags) noexcept {
  Table& table = pybind11::handle(object).cast<T&>().table();
  *view = Py_buffer{};
  if ((flags & PyBUF_WRITABLE) == PyBUF_WRITABLE && table.isReadOnly) {
    PyErr_SetString(PyExc_BufferError, "the numbers are read-only");
    return -1;
  }
  view->obj = object;
  view->buf = table.data;
  view->itemsize = table.itemSize;
  view->len = table.itemSize * table.shape[0] * (table.dimensions == 2 ? table.shape[1] : 1);
  view->readonly = table.isReadOnly ? 1 : 0;
  view->ndim = 1;
  if ((flags & PyBUF_FORMAT) == PyBUF_FORMAT) view->format = table.format;
  if ((flags & PyBUF_STRIDES) == PyBUF_STRIDES) {
    view->ndim = table.dimensions;
    view->shape = table.shape.data();
    view->strides = table.strides.data();
  }
  Py_INCREF(object);
  return 0;
}

/// For pybind11::class_, in place of its buffer_protocol().
template <class T>
pybind11::custom_type_setup tableProtocol() {
  return pybind11::custom_type_setup([](PyHeapTypeObject* type) {
    type->as_buffer.bf_getbuffer = getTable<T>;
    type->ht_type.tp_as_buffer = &type->as_buffer;
  });
}

}  // namespace allpairs::python
