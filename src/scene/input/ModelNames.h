// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "allpairs/scene/Scene.h"

namespace allpairs::scene {

/// Notes that the models behind the last source were read from a file, under the names that they have now. An empty
/// path is of no file.
void noteSources(Scene& scene, const std::filesystem::path& file);

/// Names all models by their sources: by file and object where several files have the object's name or it says nothing,
/// else by the object. Names that repeat within a file stay as they are, and so do those that a caller gave with
/// setName().
///
/// Cost: a model is named in constant expected time.
void nameModels(Scene& scene);

/// What files are called: by the end of their paths that tells them apart, most often their own name.
[[nodiscard]] std::vector<std::string> fileLabels(const std::vector<std::filesystem::path>& files);

/// Whether an object's name says nothing of it, since programs give it by themselves: "default", "Cylinder.002".
[[nodiscard]] bool isGenericName(std::string_view name);

}  // namespace allpairs::scene
