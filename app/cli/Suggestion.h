// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace allpairs::app {

/// A question that follows a word that is unknown, " - did you mean --distance?", with the choice that it resembles;
/// empty where it resembles none.
[[nodiscard]] std::string suggestionFor(std::string_view word, const std::vector<std::string>& choices);

}  // namespace allpairs::app
