// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <ostream>

namespace sofa::type {

template <class T, std::size_t N>
class fixed_array : public std::array<T, N> {
 public:
  friend std::ostream& operator<<(std::ostream& out, const fixed_array& values) {
    for (const T& value : values) out << value << ' ';
    return out;
  }
};

}  // namespace sofa::type
