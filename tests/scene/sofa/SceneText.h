// SPDX-License-Identifier: MIT
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "allpairs/Error.h"
#include "sofa/models/ModelDescription.h"

namespace allpairs::scene::sofa {

/// A folder of the test's own that goes away with it.
class Folder {
 public:
  Folder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    m_path = std::filesystem::temp_directory_path() /
             ("allpairs-" + std::string{test->test_suite_name()} + '-' + test->name() + '-' +
              std::to_string(reinterpret_cast<std::uintptr_t>(this)));
    std::filesystem::create_directories(m_path);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  Folder(Folder&&) = delete;
  Folder& operator=(Folder&&) = delete;
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(m_path, ignored);
  }

  [[nodiscard]] const std::filesystem::path& path() const { return m_path; }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    const auto file = m_path / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }

 private:
  std::filesystem::path m_path;
};

/// Reads a scene from a text, with other files beside it.
class SceneTest : public testing::Test {
 protected:
  [[nodiscard]] SceneDescription read(const std::string& text, bool partial = false) const {
    const auto file = m_folder.write("scene.scn", text);
    return describeScene(file, {.searchRoots = m_roots, .partial = partial, .maxMemory = m_maxMemory, .sofa = m_sofa});
  }

  /// The same with an outermost node around the text.
  [[nodiscard]] SceneDescription readIn(const std::string& text, bool partial = false) const {
    return read("<Node name=\"root\">\n" + text + "\n</Node>", partial);
  }

  /// What reading complains of, or nothing.
  [[nodiscard]] std::string complaint(const std::string& text) const {
    try {
      (void)read(text);
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  }

  [[nodiscard]] std::string complaintIn(const std::string& text) const {
    return complaint("<Node name=\"root\">\n" + text + "\n</Node>");
  }

  void write(const std::string& name, const std::string& text) const { m_folder.write(name, text); }

  Folder m_folder;
  std::vector<std::filesystem::path> m_roots;
  SofaVersion m_sofa = SofaVersion::FromScene;
  std::uint64_t m_maxMemory = 0;  ///< As ReadOptions::maxMemory.
};

/// Six numbers: the corners of a root box.
using Corners = std::array<double, 6>;

/// The root box by the rules of docs/semantics.md, "Models".
inline Corners boxOf(const ModelDescription& model) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Corners box{kInfinity, kInfinity, kInfinity, -kInfinity, -kInfinity, -kInfinity};
  const auto add = [&](const Vec3& p, double r) {
    for (std::size_t i = 0; i < 3; ++i) {
      box[i] = std::min(box[i], p[i] - r);
      box[i + 3] = std::max(box[i + 3], p[i] + r);
    }
  };
  const auto addAll = [&](const auto& elements, double r) {
    for (const auto& corners : elements)
      for (const auto corner : corners) add(model.positions[corner], r);
  };
  const double margin = model.contactDistance;
  addAll(model.triangles, margin);
  addAll(model.tetrahedra, 0);
  if (model.shape == ModelShape::Lines) addAll(model.lines, margin);
  for (std::size_t i = 0; i < model.positions.size(); ++i) {
    if (model.shape == ModelShape::Points) add(model.positions[i], margin);
    if (model.shape == ModelShape::Spheres) add(model.positions[i], model.radii[i] + margin);
    if (model.shape == ModelShape::Capsules) add(model.positions[i], model.radii[i / 2]);
    if (model.shape != ModelShape::OrientedBoxes) continue;
    for (unsigned corner = 0; corner < 8; ++corner) {
      const auto& h = model.halfExtents[i];
      const Vec3 local{corner & 1 ? h[0] : -h[0], corner & 2 ? h[1] : -h[1], corner & 4 ? h[2] : -h[2]};
      add(model.positions[i] + rotate(model.orientations[i], local), margin);
    }
  }
  return box;
}

MATCHER_P(IsBox, expected, "") {
  for (std::size_t i = 0; i < 6; ++i)
    if (!(std::abs(arg[i] - expected[i]) <= 1e-5 * std::max(1.0, std::abs(expected[i])))) {
      *result_listener << testing::PrintToString(arg);
      return false;
    }
  return true;
}

/// The box of the only model.
inline Corners onlyBox(const SceneDescription& scene) {
  EXPECT_EQ(scene.models.size(), 1U);
  return scene.models.empty() ? Corners{} : boxOf(scene.models[0]);
}

inline std::vector<std::string> pathsOf(const SceneDescription& scene) {
  std::vector<std::string> paths;
  for (const auto& model : scene.models) paths.push_back(model.path);
  return paths;
}

}  // namespace allpairs::scene::sofa
