// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "Clash.h"
#include "allpairs/scene/WriteResult.h"

namespace allpairs::view {

/// Where a clash's picture lies in the folder of a report: pictures/0001.png.
[[nodiscard]] std::string pictureName(std::size_t number);

/// Writes the page of a report. The first `pictured` clashes have pictures beside it.
void writeReportPage(const ViewScene& scene, std::span<const Clash> clashes, std::size_t pictured,
                     scene::ByteSink sink);

/// Writes a line for each pair, those of a row with its number and GUID: number, names, overlap per axis, volume and GUID (RFC 4180).
void writeReportCsv(const ViewScene& scene, std::span<const Clash> clashes, scene::ByteSink sink);

}  // namespace allpairs::view
