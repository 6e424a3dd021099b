// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "Clash.h"
#include "Since.h"

namespace allpairs::view {

enum class BcfVersion : std::uint8_t { V21, V30 };

/// How a BCF file is written.
struct BcfOptions {
  BcfVersion version = BcfVersion::V21;
  std::string date;                                  ///< When: 2026-01-31T12:00:00Z.
  double metresPerUnit = 1.0;                        ///< BCF's cameras stand in metres.
  std::function<std::string(const Clash&)> picture;  ///< The bytes of a clash's PNG.
  std::span<const EarlierClash> gone{};              ///< Topics to close.
};

/// The status of the topic of a row: "Closed" of what is resolved, else "Open".
[[nodiscard]] std::string_view topicStatusOf(const Clash& clash);

/// The bytes of a BCF file: for each clash a topic with a viewpoint and a picture. Models with a GlobalId are named by
/// it.
///
/// Reference: buildingSMART, BIM Collaboration Format 2.1 and 3.0, file format and schemas.
/// Bad input: what the zip library refuses throws Error.
[[nodiscard]] std::string makeBcf(const ViewScene& scene, std::span<const Clash> clashes, const BcfOptions& options);

}  // namespace allpairs::view
