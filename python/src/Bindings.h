// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace allpairs::python {

/// The parts of the modules _core and _files.
void bindErrors(pybind11::module_& module);
void bindArguments(pybind11::module_& module);
void bindPartition(pybind11::module_& module);
void bindSearch(pybind11::module_& module);
void bindElements(pybind11::module_& module);
void bindJoin(pybind11::module_& module);
void bindScene(pybind11::module_& module);
void bindWorld(pybind11::module_& module);
void bindWorlds(pybind11::module_& module);

/// Makes pickling an error for the types of a module, which are the package's own matter: pybind11's attempt ends the
/// process with protocols 0 and 1.
inline void refusePickling(const pybind11::module_& module) {
  const auto refuse = [](const pybind11::object& object) {
    throw pybind11::type_error("cannot pickle '" + std::string(Py_TYPE(object.ptr())->tp_name) + "' object");
  };
  for (const auto& [name, member] : pybind11::dict(module.attr("__dict__"))) {
    if (!pybind11::isinstance<pybind11::type>(member) || PyExceptionClass_Check(member.ptr())) continue;
    member.attr("__reduce__") = pybind11::cpp_function(refuse, pybind11::is_method(member));
  }
}

/// The text, from a place in it on, with the arguments of load() in the place of the options of the command, which
/// reads alike.
[[nodiscard]] std::string withArguments(std::string text, std::size_t begin = 0);

/// Text as Python has it: of a file, whose bytes may be no UTF-8 and are then shown by number.
[[nodiscard]] inline pybind11::object textOf(std::string_view text) {
  const auto size = static_cast<Py_ssize_t>(text.size());
  PyObject* const made = PyUnicode_DecodeUTF8(text.data(), size, "backslashreplace");
  if (made == nullptr) throw pybind11::error_already_set();
  return pybind11::reinterpret_steal<pybind11::object>(made);
}

/// A path as os.fsdecode() would give it.
[[nodiscard]] inline pybind11::object pathOf(const std::filesystem::path& path) {
  const std::string text = path.string();
  PyObject* const made = PyUnicode_DecodeFSDefaultAndSize(text.data(), static_cast<Py_ssize_t>(text.size()));
  if (made == nullptr) throw pybind11::error_already_set();
  return pybind11::reinterpret_steal<pybind11::object>(made);
}

}  // namespace allpairs::python
