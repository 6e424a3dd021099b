// SPDX-License-Identifier: MIT
#pragma once

#include "ViewScene.h"
#include "allpairs/scene/WriteResult.h"

namespace allpairs::view {

/// Writes one HTML page that shows the scene and needs nothing else: no network, no other file.
///
/// Names are data in it and never markup.
void writePage(const ViewScene& scene, scene::ByteSink sink);

}  // namespace allpairs::view
