// SPDX-License-Identifier: MIT
// C++ exceptions become those of allpairs._errors, which are plain Python.
#include <algorithm>
#include <cctype>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "Bindings.h"
#include "allpairs/Error.h"
#include "allpairs/scene/FileError.h"

namespace allpairs::python {
namespace py = pybind11;
namespace {

/// Sets Python's error to an exception of allpairs._errors.
template <class... Arguments>
void raise(const char* name, Arguments&&... arguments) {
  const py::object type = py::module_::import("allpairs._errors").attr(name);
  const py::object error = type(std::forward<Arguments>(arguments)...);
  PyErr_SetObject(type.ptr(), error.ptr());
}

/// Whether part of a text is no part of a longer word, such as a file's name.
bool isWord(std::string_view text, std::size_t at, std::size_t size) {
  const auto isInWord = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_'; };
  return !(at > 0 && text[at] != ' ' && isInWord(text[at - 1])) &&
         !(at + size < text.size() && isInWord(text[at + size]));
}

/// What a FileError says, from behind its path on in words of Python.
std::string whatOf(const FileError& error) {
  return withArguments(error.what(), std::min(error.path().string().size(), std::string_view(error.what()).size()));
}

/// The errno of Python's OSError; None where the system has not said anything.
py::object numberOf(const std::error_code& code) {
  if (!code) return py::none();
  return py::int_(code.default_error_condition().value());
}

void translateErrors(const std::exception_ptr& pointer) {
  try {
    if (pointer) std::rethrow_exception(pointer);
  } catch (const InvalidBox& error) {
    raise("InvalidBox", textOf(error.what()), error.index());
  } catch (const LimitExceeded& error) {
    raise("LimitExceeded", textOf(error.what()), error.count());
  } catch (const FileError& error) {
    raise("FileError", textOf(whatOf(error)), pathOf(error.path()), error.line(), error.column(),
          numberOf(error.code()));
  } catch (const InvalidArgument& error) {
    raise("InvalidArgument", textOf(error.what()));
  } catch (const Error& error) {
    raise("Error", textOf(error.what()));
  }
}

void translate(std::exception_ptr pointer) {
  try {
    translateErrors(pointer);
  } catch (const std::bad_alloc&) {  // of what was called, or of telling its error
    PyErr_SetString(PyExc_MemoryError, "out of memory");
  } catch (const std::length_error&) {  // more than a container can hold
    PyErr_SetString(PyExc_MemoryError, "out of memory");
  }
}

}  // namespace

std::string withArguments(std::string text, std::size_t begin) {
  static constexpr std::pair<std::string_view, std::string_view> kNames[] = {{" of detect, info, view and report", ""},
                                                                             {"--data DIR", "search_roots"},
                                                                             {"--data", "search_roots"},
                                                                             {"--max-memory", "max_memory"},
                                                                             {"--allow-outside", "allow_outside"},
                                                                             {"--partial", "partial"},
                                                                             {"--recursive", "recursive"}};
  for (const auto& [option, argument] : kNames) {
    for (std::size_t at = text.find(option, begin); at != std::string::npos; at = text.find(option, at + 1))
      if (isWord(text, at, option.size())) text.replace(at, option.size(), argument);
  }
  return text;
}

void bindErrors(py::module_& /*module*/) { py::register_local_exception_translator(translate); }

}  // namespace allpairs::python
