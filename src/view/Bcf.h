// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <span>
#include <string>

#include "Clash.h"

namespace allpairs::view {

/// How a BCF file is written.
struct BcfOptions {
  std::string date;                                  ///< When: 2026-01-31T12:00:00Z.
  double metresPerUnit = 1.0;                        ///< BCF's cameras stand in metres.
  std::function<std::string(const Clash&)> picture;  ///< The bytes of a clash's PNG.
};

/// The bytes of a BCF 2.1 file: for each clash a topic with a viewpoint and a picture.
///
/// Reference: buildingSMART, BIM Collaboration Format 2.1, file format and schemas.
/// Bad input: what the zip library refuses throws Error.
[[nodiscard]] std::string makeBcf(const ViewScene& scene, std::span<const Clash> clashes, const BcfOptions& options);

}  // namespace allpairs::view
