// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "allpairs/scene/BoxArray.h"
#include "allpairs/scene/EmptyBoxes.h"
#include "allpairs/scene/ReadOptions.h"
#include "allpairs/scene/Scene.h"
#include "allpairs/scene/WriteResult.h"
#include "cli/Options.h"

namespace allpairs::app {

/// Boxes in one block, and what else to know of their files.
struct BoxInput {
  scene::BoxArray boxes;
  std::vector<scene::Remark> warnings;
  std::vector<std::uint32_t> groups{};  ///< Of each box, if boxes of one group are no pair.
};

/// What the inputs hold together: boxes where all are box arrays, else a scene of models.
using Inputs = std::variant<BoxInput, scene::Scene>;

/// Bad input: throws UsageError.
[[nodiscard]] scene::ReadOptions readOptions(const ReadLimits& limits);

/// Does work on inputs of which those that can be read only once, such as standard input, are files meanwhile.
void withInputs(InputSettings& settings, const std::function<void()>& work);

/// What the user calls one of the inputs, or a file that was read for them.
[[nodiscard]] std::filesystem::path shownPath(const InputSettings& settings, const std::string& path);

/// Reads the inputs and puts them together in the order given. Warnings are in the result and on standard error.
[[nodiscard]] Inputs readInputs(const InputSettings& settings);

/// Boxes as models, which have shapes.
[[nodiscard]] scene::Scene toScene(const BoxInput& input);

/// What --between-inputs adds to the words for how models are tested.
[[nodiscard]] std::string betweenText(const InputSettings& settings);

/// Makes sure that what is written takes the place of none of the inputs, or of none of these files that they name.
///
/// Bad input: throws FileError.
void checkOutputs(const InputSettings& settings);
void checkOutputs(const InputSettings& settings, const std::vector<std::filesystem::path>& inputs);

/// Throws UsageError where an option was given that only scenes and folders know; `to` is what it does not apply to.
void refuseSceneOptions(const InputSettings& settings, const std::string& to);

/// Throws FileError, which names the only input, where its boxes take more memory than may be taken.
void requireMemory(const InputSettings& settings, std::uint64_t bytes);

/// Warns of what readers remarked.
void warnOf(const InputSettings& settings, const std::vector<scene::Remark>& warnings);

/// Warns that models were left out of a scene, so that a result is not of the whole input.
///
/// Bad input: where no model is left, throws FileError.
void warnOfPart(const InputSettings& settings, const scene::Scene& scene);

/// Warns of the boxes of the only input that are empty, if there are any: `each` of them in every frame or world, of
/// which `part` is the word, and which are numbered through.
void warnOfEmpty(const InputSettings& settings, const scene::EmptyBoxes& boxes, std::size_t each, const char* part);

/// What a result says about box i.
[[nodiscard]] scene::ModelRecord boxRecord(const scene::BoxArray& boxes, std::size_t i);

/// How boxes are tested, in words.
[[nodiscard]] std::string boxMethod(std::optional<double> distance, const std::optional<Box>& region);

/// Whether any of the inputs is a SOFA scene: its user knows SOFA's words.
[[nodiscard]] bool isOfSofa(const scene::Scene& scene);

/// Whether all inputs are arrays of boxes.
[[nodiscard]] bool areBoxArrays(const InputSettings& settings);

/// Whether all of them are SOFA scenes: their user asks what SOFA's broad phase finds.
[[nodiscard]] bool areScenes(const InputSettings& settings);

/// How a scene's models are tested, in words: of a SOFA scene the method and its alarm distance, of meshes as boxes.
[[nodiscard]] std::string methodText(const scene::Scene& scene);

}  // namespace allpairs::app
