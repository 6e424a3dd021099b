// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "input/ReadScope.h"
#include "mesh/MeshObject.h"

namespace allpairs::scene {

/// Adds a triangle of a strip or a fan, unless two of its corners are one: such ones lead from piece to piece, and
/// nothing is drawn of them.
void addDrawn(MeshObject& object, const std::array<std::uint32_t, 3>& triangle);

/// Adds a point, a line, or the triangles of a fan around the first corner. Where a face is not convex, some of them may
/// lie outside of it until cutFan() has exchanged them.
void addFace(MeshObject& object, std::span<const std::uint32_t> corners);

/// Exchanges the triangles of a fan by others, as many with the same corners, that lie within the face where the fan
/// does not. A face that is not flat is seen along its normal; of one that crosses itself any triangles are as good.
///
/// Returns what is wrong with the face, as "a face of 9 corners that ...", where that would take more than a second: it
/// takes the square of the corners, of few shapes the cube; or where all faces together take longer than the scope
/// allows. Else what it returns is empty.
/// Source: G. H. Meisters, "Polygons have ears", The American Mathematical Monthly 82 (1975), 648-651.
[[nodiscard]] std::string cutFan(std::span<const Point> positions, std::span<std::array<std::uint32_t, 3>> fan,
                                 ReadScope& scope);

/// Adds a face whose positions the object has, and cuts it. Returns what cutFan() does.
[[nodiscard]] std::string addCutFace(MeshObject& object, std::span<const std::uint32_t> corners, ReadScope& scope);

}  // namespace allpairs::scene
