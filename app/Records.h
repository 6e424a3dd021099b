// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "allpairs/collision/CollisionModel.h"
#include "allpairs/scene/BoxArray.h"
#include "allpairs/scene/Scene.h"
#include "allpairs/scene/WriteResult.h"

namespace allpairs::app {

/// What a result says about box i.
[[nodiscard]] scene::ModelRecord boxRecord(const scene::BoxArray& boxes, std::size_t i);

/// How a scene's models are tested, in words: the method and its alarm distance.
[[nodiscard]] std::string methodText(const scene::Scene& scene);

/// 1234567 as 1,234,567.
[[nodiscard]] std::string grouped(std::uint64_t number);

/// `count` and the noun, in the plural unless it is 1: "3 boxes".
[[nodiscard]] std::string counted(std::uint64_t count, const std::string& noun, const std::string& plural = {});

/// The text with its control characters written as \x1b, so that a terminal shows them and does not obey them.
[[nodiscard]] std::string printable(const std::string& text);

/// A box as [0, 0, 0] to [1, 1, 1], short enough to read.
[[nodiscard]] std::string boxText(const Box& box);

}  // namespace allpairs::app
