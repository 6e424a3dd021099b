// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "allpairs/scene/ReadOptions.h"
#include "sofa/graph/SceneGraph.h"

namespace allpairs::scene::sofa {

/// The SOFAs whose answers differ, by the last of each.
enum class Generation { Sofa20, Sofa26 };

/// The generation that was asked for, or else the one that knows all components of a scene; the older if both do.
[[nodiscard]] Generation generationOf(const Node& root, SofaVersion asked);

/// Names components that have no name as newer SOFA does: by their class and a number of their own in each node; nodes
/// without a name stay without.
void nameByClass(Node& node);

/// The class behind a name in a scene, as newer SOFA calls it: "TriangleCollisionModel" for "Triangle".
[[nodiscard]] std::string newClassName(const Component& component);

/// Why the name of a component is not what a SOFA of the generation makes of it: the name is one that newer SOFA does
/// not have any more, or a slip. Empty for nothing.
[[nodiscard]] std::string doubtAboutName(const Component& component, Generation generation);

}  // namespace allpairs::scene::sofa
