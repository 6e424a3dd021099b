// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

namespace allpairs::scene {

/// The names of an IFC's products by their GlobalIds. Assimp leaves out blanks, and decodes nothing.
///
/// Cost: linear in the text. What is no STEP file has no names.
[[nodiscard]] std::unordered_map<std::string, std::string> ifcNames(std::string_view text);

/// Of some products of an IFC, by their GlobalIds, those that have a bounding box for a shape.
///
/// Cost: linear in the text.
[[nodiscard]] std::unordered_set<std::string> ifcProductsOfBoxes(std::string_view text,
                                                                 const std::unordered_set<std::string>& ids);

/// A string of a STEP file, without its quotes, in UTF-8; what is not encoded stays as it is.
///
/// Reference: ISO 10303-21, clause 6.4.3.
[[nodiscard]] std::string decodedStep(std::string_view text);

}  // namespace allpairs::scene
